#pragma once
#include <CLI/App.hpp>
#include <functional>

#include "apps/graph/optimize.h"

namespace placegraph::apps {

/// Adds `placegraph graph optimize IN -o OUT`, which optimizes a pose graph.
/// `write_page` writes the page that shows the graph (`--report`).
void add_optimize_command(
    CLI::App& graph,
    const std::function<void(const OptimizeArguments&, const OptimizeResult&)>& write_page);

}  // namespace placegraph::apps
