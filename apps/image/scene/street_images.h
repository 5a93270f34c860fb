#pragma once
#include <placegraph/graph/scene/scene_model.h>

#include <memory>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Probability that each image shows a street, by its surfaces and straight edges.
///
/// `in_sequence`: the images follow each other; then each is judged with its neighbours, and the
/// evidence is that of up to every fifth image. `surfaces`: the installed model. Progress goes to
/// stderr. Throws FileError for an image that cannot be read or is too small.
std::vector<double> street_probabilities(const std::vector<std::string>& images,
                                         const std::shared_ptr<const SceneModel>& surfaces,
                                         bool in_sequence, int threads);

}  // namespace placegraph::apps
