#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph eval edges POSES RUN`.
/// It compares the errors of a place graph's edges with their stated covariances.
void add_eval_edges_command(CLI::App& eval_group);

}  // namespace placegraph::apps
