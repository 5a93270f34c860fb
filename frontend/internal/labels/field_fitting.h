#pragma once
#include <placegraph/frontend/internal/labels/scene_training_set.h>

#include <vector>

namespace placegraph {

/// How often which classes lie above, below and beside each other in the examples.
[[nodiscard]] RelationTable learn_relations(const std::vector<SceneExample>& examples,
                                            const SceneTrainingSet& training_set);

/// Chooses the weights of a model's random field (LabelField) and how sharp its probabilities are,
/// with the relations that it has. `shares`: what the forest says of every row of the lesson
/// without having seen its block, rows x classes. The weights are those of the best pixel accuracy
/// plus mean intersection over union, the smaller ones of equals; the sharpness is the exponent
/// with the least mean -log of the right class's probability.
void fit_field(const std::vector<SceneExample>& examples, const SceneTrainingSet& training_set,
               const std::vector<float>& shares, SceneModel& model);

}  // namespace placegraph
