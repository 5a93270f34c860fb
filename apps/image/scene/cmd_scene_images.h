#pragma once
#include <CLI/App.hpp>

#include "apps/image/scene/scene_images.h"

namespace placegraph::apps {

/// Adds the common options of `image labels` and `image surfaces`; `json`: print JSON.
void add_scene_image_options(CLI::App& command, SceneImageArguments& arguments, bool& json);

}  // namespace placegraph::apps
