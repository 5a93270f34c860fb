#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph train planarity --out MODEL`: which segments of clouds are planes, learned from
/// rendered worlds and generated clouds.
void add_train_planarity_command(CLI::App& train);

}  // namespace placegraph::apps
