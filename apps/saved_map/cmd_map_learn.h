#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph map learn`.
void add_map_learn_command(CLI::App& map);

}  // namespace placegraph::apps
