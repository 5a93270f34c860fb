#pragma once
#include <placegraph/graph/scene/scene_model.h>

#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph train surfaces` or `train urban`.
void add_train_scene_command(CLI::App& train, SceneModel::Kind kind, const char* about);

}  // namespace placegraph::apps
