#pragma once
#include <placegraph/graph/core/se3.h>

#include <cstdint>
#include <functional>
#include <optional>

namespace placegraph {

/// How two keyframes lie to each other by odometry, and the length of the way between them.
struct TrackedMotion {
  SE3 T_a_b;
  double way = 0;  ///< in the map's unit
};

/// Of keyframes a and b; nothing where no unbroken run of tracking joins the two.
using MotionBetween = std::function<std::optional<TrackedMotion>(std::int64_t a, std::int64_t b)>;

}  // namespace placegraph
