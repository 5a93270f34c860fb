#pragma once
#include <CLI/App.hpp>

#include "apps/scene/scene_pictures.h"

namespace placegraph::apps {

/// The options that `scene label` and `scene surfaces` have in common; `json`: print JSON.
void add_scene_picture_options(CLI::App& command, ScenePictureArguments& arguments, bool& json);

}  // namespace placegraph::apps
