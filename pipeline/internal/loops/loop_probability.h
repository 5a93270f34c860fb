#pragma once
#include <placegraph/graph/map.h>

namespace placegraph {

/// How probable it is that query and match of a record show one place, by the stage that decided,
/// how similar the views are, and how many points and lines agree with one pose: a logistic model
/// whose coefficients were fitted to candidates of rendered drives whose truth is known
/// (docs/places.md, tests/bench/loop_probability_study).
double loop_probability(const LoopRecord& record);

/// What the model sees of a record.
struct LoopFeatures {
  LoopStage stage = LoopStage::kRetrieval;
  /// Within bounds. Once a relative pose has been found, similarity tells nothing more: 0.
  double log_similarity = 0;
  double log_agreeing = 0;  ///< of one and the points and lines that agree
};
LoopFeatures loop_features(const LoopRecord& record);

}  // namespace placegraph
