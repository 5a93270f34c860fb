#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph train urban DATA --out MODEL`: learns the model of `scene label`.
void add_train_urban_command(CLI::App& train);

}  // namespace placegraph::apps
