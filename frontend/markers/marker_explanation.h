#pragma once
#include <placegraph/frontend/markers/beacon_pose.h>
#include <placegraph/frontend/markers/square_pose.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Log-likelihood of Student's distribution with four degrees of freedom, relative to its maximum.
///
/// `chi2` is the squared error over `dimensions`. Large errors count against a hypothesis, but no
/// single one excludes it permanently.
double log_likelihood(double chi2, int dimensions);

/// A camera's pose and its covariance (right tangent).
struct KnownCamera {
  SE3 T_world_cam;
  Matrix6d covariance = Matrix6d::Zero();
};

/// A camera pose that explains the markers and beacons of an image.
struct MarkerExplanation {
  SquarePose pose;           ///< T_ref_cam: pose of the camera in the world
  std::vector<int> squares;  ///< squares that fit the pose
  BeaconPairs beacons;
  double log_likelihood_sum = 0;  ///< outliers count as at the gate
};

/// All poses that explain the markers and beacons of an image.
struct MarkerExplanations {
  /// Outcomes: too few data (no square, too few spots), those of find_beacon_pose.
  Outcome outcome;
  std::vector<MarkerExplanation> found;
};

/// Finds all poses at which the error of known squares and beacons has a minimum.
///
/// Squares and beacons have known positions in the world. A single minimum is complemented by its
/// mirrored rival. From both poses of every square, all squares and the beacons that the pose
/// assigns unambiguously are solved together; squares outside `gate` (chi^2) are left out, worst
/// first. Without squares the pose is estimated from the beacons, about `expected` if given, else
/// without a prior.
MarkerExplanations explain_markers(const Camera& camera, const std::vector<SeenSquare>& squares,
                                   const std::vector<BeaconObservation>& spots,
                                   const std::vector<Eigen::Vector3d>& beacons_world, double gate,
                                   const BeaconPoseOptions& options,
                                   const std::optional<KnownCamera>& expected);

}  // namespace placegraph
