#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph eval noise TRUTH`.
/// It estimates the noise of true poses from the poses alone.
void add_eval_noise_command(CLI::App& eval_group);

}  // namespace placegraph::apps
