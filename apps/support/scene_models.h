#pragma once
#include <placegraph/graph/scene/scene_model.h>

#include <string>

namespace placegraph::apps {

/// The file of a model: `given`, or where it is empty the one that came with the program: in
/// $PLACEGRAPH_MODELS, in ../share/placegraph/models beside the program's folder, or in
/// configs/models of the source. Throws FileError naming the command that makes it if it is in
/// none.
std::string scene_model_path(SceneModel::Kind kind, const std::string& given);

/// Reads it; throws FileError also where it is a model of the other kind.
SceneModel load_scene_model(SceneModel::Kind kind, const std::string& given);

/// "surfaces" or "urban".
std::string name_of(SceneModel::Kind kind);

}  // namespace placegraph::apps
