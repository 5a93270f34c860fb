#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph eval loops`, which evaluates place recognizers against ground truth.
void add_eval_loops_command(CLI::App& eval_group);

}  // namespace placegraph::apps
