#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph map`: what a saved map holds, whether it is whole, and its parts as files; maps
/// learned from images alone.
void add_map_commands(CLI::App& map);

}  // namespace placegraph::apps
