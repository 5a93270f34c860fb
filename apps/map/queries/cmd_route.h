#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph map route MAP --from A --to B`, which finds the shortest path.
void add_route_command(CLI::App& map);

}  // namespace placegraph::apps
