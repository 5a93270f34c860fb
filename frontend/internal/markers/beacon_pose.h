#pragma once
#include <placegraph/frontend/internal/markers/beacon_detector.h>
#include <placegraph/frontend/internal/markers/marker_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/se3.h>

#include <utility>
#include <vector>

namespace placegraph {

/// Which spot is which beacon: (index of the spot, index of the beacon).
using BeaconPairs = std::vector<std::pair<int, int>>;

/// The spots' beacons where the camera's pose is known to a covariance (right tangent of
/// T_world_cam): a spot and a beacon that lie within the gate of each other and of nothing else.
BeaconPairs assign_beacons(const std::vector<BeaconObservation>& spots,
                           const std::vector<Eigen::Vector3d>& beacons_world, const Camera& camera,
                           const SE3& T_world_cam, const Matrix6d& covariance,
                           const BeaconPoseOptions& options = {});

struct BeaconPose {
  Outcome outcome;
  SE3 T_world_cam;
  Matrix6d covariance = Matrix6d::Zero();  ///< right tangent
  BeaconPairs pairs;
  double chi2 = 0;
};

/// The camera's pose from spots and beacons that all look alike, nothing else known: three spots
/// are given to any three beacons in turn (Kneip et al. 2011), the others tell which is right.
/// Outcomes: too few data (fewer than `min_spots` spots or beacons), no consensus, inconsistent
/// (two different poses explain the spots), degenerate.
[[nodiscard]] BeaconPose find_beacon_pose(const std::vector<BeaconObservation>& spots,
                                          const std::vector<Eigen::Vector3d>& beacons_world,
                                          const Camera& camera,
                                          const BeaconPoseOptions& options = {});

}  // namespace placegraph
