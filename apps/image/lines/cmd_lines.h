#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph image lines IMAGE` and `placegraph image match-lines A B`.
void add_lines_commands(CLI::App& image);

}  // namespace placegraph::apps
