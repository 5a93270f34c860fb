#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph map learn IMAGES --out MAP`.
void add_map_learn_command(CLI::App& map);

}  // namespace placegraph::apps
