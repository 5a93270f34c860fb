#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph eval labels LABELS DATA`, which evaluates label images.
void add_eval_labels_command(CLI::App& eval_group);

}  // namespace placegraph::apps
