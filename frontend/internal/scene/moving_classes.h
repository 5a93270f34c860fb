#pragma once
#include <placegraph/graph/scene/scene_model.h>

#include <string>
#include <vector>

namespace placegraph {

/// Whether each class of the model is one of `names`, joined by commas. Throws ArgumentError for a
/// name that is no class of it.
std::vector<bool> moving_classes(const std::string& names, const SceneModel& model);

}  // namespace placegraph
