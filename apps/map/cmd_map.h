#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph map info`, `validate`, `export`, `learn`, `label`, `plan` and `street`.
void add_map_commands(CLI::App& map);

}  // namespace placegraph::apps
