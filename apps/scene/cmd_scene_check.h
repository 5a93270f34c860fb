#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph scene check LABELS DATA`: label images against those that people made.
void add_eval_labels_command(CLI::App& eval_group);

}  // namespace placegraph::apps
