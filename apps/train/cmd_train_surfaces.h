#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph train surfaces DATA --out MODEL`: learns the model of `scene surfaces`.
void add_train_surfaces_command(CLI::App& train);

}  // namespace placegraph::apps
