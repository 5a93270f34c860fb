#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph graph bundle IN`: bundle adjustment of a problem in BAL format.
void add_bundle_command(CLI::App& graph);

}  // namespace placegraph::apps
