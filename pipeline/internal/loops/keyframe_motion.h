#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/geometry/sim3.h>

#include <cstdint>
#include <functional>
#include <optional>

namespace placegraph {

/// How two keyframes lie to each other by odometry, and the length of the path between them.
struct TrackedMotion {
  SE3 T_a_b;
  double path_length = 0;  ///< in the unit of the run of tracking
};

/// How two keyframes lie to each other by the map, loops and all.
struct PredictedMotion {
  Sim3 S_a_b;
  Matrix7d covariance = Matrix7d::Zero();  ///< in its right tangent; over SE(3) without the last
  double path_length = 0;  ///< of the shortest path along links and loops, in b's unit
};

/// Of keyframes a and b; nothing where no unbroken run of tracking joins the two.
using MotionBetween = std::function<std::optional<TrackedMotion>(KeyframeId a, KeyframeId b)>;

/// What is asked about two keyframes while revisits are sought; without an answer to give, nothing
/// is checked by it.
struct KnownMotions {
  MotionBetween odometry;
  std::function<std::optional<PredictedMotion>(KeyframeId a, KeyframeId b)> map;
  /// Whether the two have scales of their own, so that a loop between them must tell their ratio.
  std::function<bool(KeyframeId a, KeyframeId b)> scale_differs;
};

}  // namespace placegraph
