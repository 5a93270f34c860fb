#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph map label`.
void add_map_label_command(CLI::App& map);

}  // namespace placegraph::apps
