#pragma once
#include <placegraph/graph/scene/scene_model.h>

namespace placegraph {

/// Puts the trees of `base` before those of `model`, whose first classes are those of `base`.
///
/// The old trees assign no share to new classes. Throws ArgumentError if the classes or features do
/// not agree.
void keep_trees(const SceneModel& base, SceneModel& model);

}  // namespace placegraph
