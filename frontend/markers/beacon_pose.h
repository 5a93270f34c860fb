#pragma once
#include <placegraph/frontend/markers/beacon_detector.h>
#include <placegraph/frontend/markers/marker_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/se3.h>

#include <utility>
#include <vector>

namespace placegraph {

/// Correspondences of spots and beacons: (index of the spot, index of the beacon).
using BeaconPairs = std::vector<std::pair<int, int>>;

/// Assigns spots to beacons, given the camera's pose with a covariance.
///
/// The covariance is in the right tangent of T_world_cam. A spot and a beacon correspond if they
/// are within the gate of each other and of no others.
BeaconPairs assign_beacons(const std::vector<BeaconObservation>& spots,
                           const std::vector<Eigen::Vector3d>& beacons_world, const Camera& camera,
                           const SE3& T_world_cam, const Matrix6d& covariance,
                           const BeaconPoseOptions& options = {});

/// Pose of a camera from beacons.
struct BeaconPose {
  Outcome outcome;
  SE3 T_world_cam;
  Matrix6d covariance = Matrix6d::Zero();  ///< right tangent
  BeaconPairs pairs;
  double chi2 = 0;
};

/// Estimates the camera's pose from spots and indistinguishable beacons, without a prior.
///
/// Three spots are assigned to all triples of beacons in turn (Kneip et al. 2011); the other spots
/// verify the pose. Outcomes: too few data (fewer than `min_spots` spots or beacons), no consensus,
/// inconsistent (two different poses explain the spots), degenerate.
[[nodiscard]] BeaconPose find_beacon_pose(const std::vector<BeaconObservation>& spots,
                                          const std::vector<Eigen::Vector3d>& beacons_world,
                                          const Camera& camera,
                                          const BeaconPoseOptions& options = {});

}  // namespace placegraph
