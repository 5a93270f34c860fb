#pragma once
#include <placegraph/frontend/markers/marker_detector.h>
#include <placegraph/pipeline/flight/flight_options.h>
#include <placegraph/pipeline/flight/marker_map.h>

#include <map>
#include <vector>

namespace placegraph {

/// A frame with externally known motion, and the markers in it.
struct MarkerFrame {
  SE3 T_odom_cam;
  /// Covariance of the motion from the previous frame (right tangent of T_before_this); not used
  /// for the first frame.
  Matrix6d step_covariance = Matrix6d::Identity();
  std::vector<MarkerObservation> markers;
};

/// Estimates markers as landmarks of a pose graph: frames are connected by their motions, frames
/// and markers by the marker's pose in the frame with its covariance; of the two poses of an
/// observation, the one that agrees with the other frames is used. Markers of `known` are fixed and
/// define the world frame; without any, the first frame's odometry does. `sides_m`: sides of the
/// unknown markers; others are ignored. Throws ArgumentError for a side that is not positive.
[[nodiscard]] MarkerMap map_markers(const std::vector<MarkerFrame>& frames,
                                    const MarkerLayout& known, const std::map<int, double>& sides_m,
                                    const Camera& camera, const MarkerMapOptions& options = {});

}  // namespace placegraph
