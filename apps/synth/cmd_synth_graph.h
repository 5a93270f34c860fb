#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph synth graph WORLD -o OUT.g2o`, which makes pose graphs for tests.
void add_synth_graph_command(CLI::App& synth_group);

}  // namespace placegraph::apps
