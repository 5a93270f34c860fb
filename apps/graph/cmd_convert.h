#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph graph convert IN OUT`, which converts trajectories and pose graphs.
void add_convert_command(CLI::App& graph);

}  // namespace placegraph::apps
