#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/geometry/sim3.h>

#include <cstdint>
#include <functional>
#include <optional>

namespace placegraph {

/// Relative pose of two keyframes by odometry, and the path length between them.
struct TrackedMotion {
  SE3 T_a_b;
  double path_length = 0;  ///< in the scale of the track segment
};

/// Relative pose of two keyframes according to the map, including loops.
struct PredictedMotion {
  Sim3 S_a_b;
  Matrix7d covariance = Matrix7d::Zero();  ///< in its right tangent; over SE(3) without the last
  double path_length = 0;  ///< length of the shortest path along links and loops, in b's scale
};

/// Motion between keyframes a and b; nothing if they are in different track segments.
using MotionBetween = std::function<std::optional<TrackedMotion>(KeyframeId a, KeyframeId b)>;

/// Sources of relative poses during loop detection; a check whose source is empty is skipped.
struct KnownMotions {
  MotionBetween odometry;
  std::function<std::optional<PredictedMotion>(KeyframeId a, KeyframeId b)> map;
  /// Whether the ratio of the two keyframes' scales is unknown, so that a loop between them must
  /// estimate it.
  std::function<bool(KeyframeId a, KeyframeId b)> scale_unknown;
  /// Whether the two keyframes are in different components of the map, which a loop would join.
  std::function<bool(KeyframeId a, KeyframeId b)> apart;
};

}  // namespace placegraph
