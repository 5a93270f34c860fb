#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph train WHAT ...`: models that come with the library, learned anew. Each model is a
/// subcommand in a file of its own.
void add_train_command(CLI::App& app);

}  // namespace placegraph::apps
