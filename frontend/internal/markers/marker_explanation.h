#pragma once
#include <placegraph/frontend/internal/markers/beacon_pose.h>
#include <placegraph/frontend/internal/markers/square_pose.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Logarithm of Student's distribution with four degrees of freedom over `dimensions`, less that of
/// its top: what is far away refutes, but no single number refutes for ever.
double log_likelihood(double chi2, int dimensions);

/// A camera's pose, and how well it is known (right tangent).
struct KnownCamera {
  SE3 T_world_cam;
  Matrix6d covariance = Matrix6d::Zero();
};

/// One way to explain the markers and beacons of an image.
struct MarkerExplanation {
  SquarePose pose;           ///< T_ref_cam: of the camera in the world
  std::vector<int> squares;  ///< that fit it
  BeaconPairs beacons;
  double log_likelihood_sum = 0;  ///< log-likelihood; what does not fit counts as at the gate
};

struct MarkerExplanations {
  /// Outcomes: too few data (no square, too few spots), those of find_beacon_pose.
  Outcome outcome;
  std::vector<MarkerExplanation> found;
};

/// All poses at which the error of squares and beacons of known places (in the world) has a
/// minimum, and the rival of a single one: from both poses of every square, all squares and the
/// beacons that the pose makes plain solved together, squares outside `gate` (chi^2) left out,
/// worst first. Without squares the beacons stand alone: about `expected`, else from nothing.
MarkerExplanations explain_markers(const Camera& camera, const std::vector<SeenSquare>& squares,
                                   const std::vector<BeaconObservation>& spots,
                                   const std::vector<Eigen::Vector3d>& beacons_world, double gate,
                                   const BeaconPoseOptions& options,
                                   const std::optional<KnownCamera>& expected);

}  // namespace placegraph
