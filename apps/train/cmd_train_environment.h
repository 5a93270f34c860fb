#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Registers `placegraph train environment`.
void add_train_environment_command(CLI::App& train_command);

}  // namespace placegraph::apps
