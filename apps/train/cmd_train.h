#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph train surfaces`, `urban`, `planarity` and `environment`.
void add_train_commands(CLI::App& train);

}  // namespace placegraph::apps
