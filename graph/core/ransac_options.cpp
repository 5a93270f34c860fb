#include <placegraph/graph/core/ransac_options.h>

namespace placegraph {

void visit(OptionVisitor& field, RansacOptions& options) {
  field("max_iterations", options.max_iterations, "maximum number of samples", {1, 1e7});
  field("confidence", options.confidence,
        "probability of an outlier-free sample at which sampling stops", {0.01, 1 - 1e-12});
  field("min_inliers", options.min_inliers, "minimum number of inliers of a model", {1, 1e7});
}

}  // namespace placegraph
