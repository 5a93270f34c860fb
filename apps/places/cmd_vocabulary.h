#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph vocabulary train IMAGES... --out FILE`, `placegraph vocabulary info FILE`.
void add_vocabulary_command(CLI::App& app);

}  // namespace placegraph::apps
