#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph train surfaces DATA --out MODEL`, the model of `image surfaces`.
void add_train_surfaces_command(CLI::App& train);

}  // namespace placegraph::apps
