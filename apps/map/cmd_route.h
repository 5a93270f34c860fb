#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph route MAP --from A --to B [--backtrack]`: the shortest way over a run's places.
void add_route_command(CLI::App& map);

}  // namespace placegraph::apps
