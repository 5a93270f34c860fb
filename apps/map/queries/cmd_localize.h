#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph map localize MAP IMAGES`, which localizes new images in a saved map.
void add_localize_command(CLI::App& map);

}  // namespace placegraph::apps
