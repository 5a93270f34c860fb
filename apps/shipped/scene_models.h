#pragma once
#include <placegraph/graph/scene/scene_model.h>

#include <string>

namespace placegraph::apps {

/// Path of a model: `given`, or if it is empty the installed model.
/// That is in $PLACEGRAPH_MODELS, in ../share/placegraph/models beside the program's folder, or in
/// configs/models of the source. Throws FileError with the command that makes the model if it is in
/// none of them.
std::string scene_model_path(SceneModel::Kind kind, const std::string& given);

/// Reads a model. Throws FileError also for a model of the other kind.
SceneModel load_scene_model(SceneModel::Kind kind, const std::string& given);

/// "surfaces" or "urban".
std::string name_of(SceneModel::Kind kind);

}  // namespace placegraph::apps
