#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph map loops refuse|accept|add MAP PAIR... -o FILE`.
void add_map_loops_commands(CLI::App& map);

}  // namespace placegraph::apps
