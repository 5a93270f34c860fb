#pragma once
#include <placegraph/frontend/labels/training/scene_training_set.h>

#include <vector>

namespace placegraph {

/// Frequencies of the classes above, below and beside each other in the examples.
[[nodiscard]] RelationTable learn_relations(const std::vector<SceneExample>& examples,
                                            const SceneTrainingSet& training_set);

/// Chooses the weights of a model's random field (LabelField) and the sharpness of its
/// probabilities.
///
/// The model's relations are kept. `shares`: prediction of the forest for every row of the training
/// set without the row's own block, rows x classes. The weights are those of the best pixel
/// accuracy plus mean intersection over union, the smaller ones if equal; the sharpness is the
/// exponent with the least mean -log of the correct class's probability.
void fit_field(const std::vector<SceneExample>& examples, const SceneTrainingSet& training_set,
               const std::vector<float>& shares, SceneModel& model);

}  // namespace placegraph
