#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph places match DIR --out FILE`, which finds an older image of the same place.
void add_match_command(CLI::App& places);

}  // namespace placegraph::apps
