#include <placegraph/graph/core/ransac.h>

namespace placegraph {

int ransac_iterations(double inlier_ratio, int sample_size, double confidence, int max) {
  const double all_inliers = std::pow(inlier_ratio, sample_size);
  if (all_inliers >= 1) return 1;
  if (!(all_inliers > 0)) return max;
  const double needed = std::ceil(std::log1p(-confidence) / std::log1p(-all_inliers));
  return static_cast<int>(std::clamp(needed, 1.0, static_cast<double>(max)));
}

}  // namespace placegraph
