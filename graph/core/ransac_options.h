#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// How long RANSAC draws samples and which support a model needs (Fischler & Bolles 1981).
struct RansacOptions {
  int max_iterations = 300;   ///< samples drawn at most
  double confidence = 0.999;  ///< stop once a sample of inliers alone was drawn with this chance
  int min_inliers = 12;       ///< a model with fewer is refused: Outcome kNoConsensus
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, RansacOptions& options);

}  // namespace placegraph
