#include <placegraph/graph/core/ransac.h>

namespace placegraph {

void visit(OptionVisitor& field, RansacOptions& options) {
  field("max_iterations", options.max_iterations, "samples drawn at most", {1, 1e7});
  field("confidence", options.confidence, "wanted probability of one sample without outliers",
        {0.01, 1 - 1e-12});
  field("min_inliers", options.min_inliers, "a model with fewer inliers is no consensus", {1, 1e7});
}

int ransac_iterations(double inlier_ratio, int sample_size, double confidence, int max) {
  const double all_inliers = std::pow(inlier_ratio, sample_size);
  if (all_inliers >= 1) return 1;
  if (!(all_inliers > 0)) return max;
  const double needed = std::ceil(std::log1p(-confidence) / std::log1p(-all_inliers));
  return static_cast<int>(std::clamp(needed, 1.0, static_cast<double>(max)));
}

}  // namespace placegraph
