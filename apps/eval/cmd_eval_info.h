#pragma once

#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph eval info TRAJECTORY...`, which needs no ground truth.
void add_eval_info_command(CLI::App& eval_group);

}  // namespace placegraph::apps
