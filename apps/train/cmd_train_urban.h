#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph train urban DATA --out MODEL`, the model of `image labels`.
void add_train_urban_command(CLI::App& train);

}  // namespace placegraph::apps
