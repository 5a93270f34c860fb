#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph eval GT EST...`: figures of estimated trajectories against ground truth.
void add_eval_trajectory_command(CLI::App& eval_group);

}  // namespace placegraph::apps
