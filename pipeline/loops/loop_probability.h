#pragma once
#include <placegraph/graph/map.h>

namespace placegraph {

/// Probability that query and match of a record show the same place, from the stage that decided,
/// the similarity of the views, and the number of points and lines that agree with one pose. It is
/// a logistic model whose coefficients were fitted to candidates of rendered drives with ground
/// truth (docs/place_graph.md, tests/bench/loop_probability_study).
double loop_probability(const LoopRecord& record);

/// Inputs of the model.
struct LoopFeatures {
  LoopStage stage = LoopStage::kRetrieval;
  /// Logarithm of the similarity, within bounds; 0 once a relative pose has been found, because
  /// similarity then carries no further information.
  double log_similarity = 0;
  double log_agreeing = 0;  ///< logarithm of one plus the number of points and lines that agree
};
LoopFeatures loop_features(const LoopRecord& record);

}  // namespace placegraph
