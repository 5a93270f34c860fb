#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph match DIR --out FILE [--sequence]`: which older image shows the place of each.
void add_match_command(CLI::App& places);

}  // namespace placegraph::apps
