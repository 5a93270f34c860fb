#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph eval-edges GT RUN`: whether the edges of a run's place graph know what they claim.
void add_eval_edges_command(CLI::App& eval_group);

}  // namespace placegraph::apps
