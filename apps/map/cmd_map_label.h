#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph map label MAP ROOMS`.
void add_map_label_command(CLI::App& map);

}  // namespace placegraph::apps
