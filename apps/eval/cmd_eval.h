#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph eval trajectory TRUTH EST...`, which evaluates estimated trajectories.
void add_eval_trajectory_command(CLI::App& eval_group);

}  // namespace placegraph::apps
