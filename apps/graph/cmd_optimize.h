#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph optimize IN.g2o -o OUT.g2o`: a pose graph's best estimate.
void add_optimize_command(CLI::App& graph);

}  // namespace placegraph::apps
