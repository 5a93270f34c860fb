#pragma once
#include <placegraph/graph/scene/scene_model.h>

#include <string>
#include <vector>

namespace placegraph {

/// Whether each class of the model is one of `names`, joined by commas.
///
/// Throws ArgumentError for a name that is not a class of the model.
std::vector<bool> moving_classes(const std::string& names, const SceneModel& model);

}  // namespace placegraph
