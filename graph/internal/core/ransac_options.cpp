#include <placegraph/graph/core/ransac_options.h>

namespace placegraph {

void visit(OptionVisitor& field, RansacOptions& options) {
  field("max_iterations", options.max_iterations, "samples drawn at most", {1, 1e7});
  field("confidence", options.confidence, "wanted probability of one sample without outliers",
        {0.01, 1 - 1e-12});
  field("min_inliers", options.min_inliers, "a model with fewer inliers is no consensus", {1, 1e7});
}

}  // namespace placegraph
