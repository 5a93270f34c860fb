#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph graph optimize IN -o OUT`, which optimizes a pose graph.
void add_optimize_command(CLI::App& graph);

}  // namespace placegraph::apps
