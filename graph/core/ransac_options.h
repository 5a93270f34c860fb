#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

struct RansacOptions {
  int max_iterations = 300;
  double confidence = 0.999;  ///< probability of having drawn one all-inlier sample
  int min_inliers = 12;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, RansacOptions& options);

}  // namespace placegraph
