#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph loops`: what place recognizers found, judged against ground truth.
void add_eval_loops_command(CLI::App& eval_group);

}  // namespace placegraph::apps
