#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph train planarity --out MODEL`.
/// It learns which segments of clouds are planes, from rendered worlds and generated clouds.
void add_train_planarity_command(CLI::App& train);

}  // namespace placegraph::apps
