#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph vocabulary train IMAGES... --out FILE`, `placegraph vocabulary info FILE`.
void add_train_vocabulary_command(CLI::App& train);
void add_vocabulary_command(CLI::App& places);

}  // namespace placegraph::apps
