#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph train vocabulary IMAGES... --out FILE` and `placegraph places vocabulary FILE`.
void add_train_vocabulary_command(CLI::App& train);
void add_vocabulary_command(CLI::App& places);

}  // namespace placegraph::apps
