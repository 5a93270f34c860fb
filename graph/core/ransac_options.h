#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Stopping criterion and minimum support of a model in RANSAC (Fischler & Bolles 1981).
struct RansacOptions {
  int max_iterations = 300;   ///< maximum number of samples
  double confidence = 0.999;  ///< probability of an outlier-free sample at which sampling stops
  int min_inliers = 12;       ///< minimum number of inliers of a model, else Outcome kNoConsensus
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, RansacOptions& options);

}  // namespace placegraph
