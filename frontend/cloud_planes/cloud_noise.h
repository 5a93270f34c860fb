#pragma once
#include <algorithm>

namespace [[gnu::visibility("default")]] placegraph {

/// Standard deviation of a point: `at_1m` times depth to the `power` [m].
///
/// Power 0: constant, 1: a share of the depth (laser), 2: a constant disparity (stereo, depth
/// cameras).
struct CloudNoise {
  double at_1m = 0;
  int power = 1;
  double least_m = 0;  ///< least value, from the quantization of the depths
  double shared = 0;   ///< in an image: variance that neighbours have in common, over their own
  double sigma(double depth_m) const {
    constexpr double kLeastShare = 1e-5;  // of the depth: less noise than that is rounding
    const double factor = power == 0 ? 1 : power == 1 ? depth_m : depth_m * depth_m;
    return std::max({at_1m * factor, least_m, kLeastShare * depth_m});
  }
};

}  // namespace placegraph
