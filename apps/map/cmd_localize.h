#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph localize`: new images placed in a saved map.
void add_localize_command(CLI::App& map);

}  // namespace placegraph::apps
