#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph synth-graph WORLD -o OUT.g2o`: pose graphs to practise on.
void add_synth_graph_command(CLI::App& synth_group);

}  // namespace placegraph::apps
