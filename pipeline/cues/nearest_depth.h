#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace placegraph {

/// A pixel of known depth.
struct KnownDepth {
  Eigen::Vector2f px;
  double depth;
};

/// Depth of a pixel without a measurement: the median of the depths of the three nearest pixels
/// that have one; `otherwise` if fewer are known.
inline double depth_nearby(const std::vector<KnownDepth>& known, const Eigen::Vector2f& px,
                           double otherwise) {
  // Chosen: the median of three survives one outlier.
  constexpr std::size_t kNeighbours = 3;
  if (known.size() < kNeighbours) return otherwise;
  std::array<std::pair<float, double>, kNeighbours> nearest;  // squared distance, depth
  nearest.fill({std::numeric_limits<float>::infinity(), otherwise});
  for (const KnownDepth& k : known) {
    const float distance = (k.px - px).squaredNorm();
    if (distance >= nearest.back().first) continue;
    std::size_t at = kNeighbours - 1;
    for (; at > 0 && nearest[at - 1].first > distance; --at) nearest[at] = nearest[at - 1];
    nearest[at] = {distance, k.depth};
  }
  std::array<double, kNeighbours> depths;
  for (std::size_t i = 0; i < kNeighbours; ++i) depths[i] = nearest[i].second;
  std::nth_element(depths.begin(), depths.begin() + kNeighbours / 2, depths.end());
  return depths[kNeighbours / 2];
}

}  // namespace placegraph
