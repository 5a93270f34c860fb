#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph train environment`.
void add_train_environment_command(CLI::App& train_command);

}  // namespace placegraph::apps
