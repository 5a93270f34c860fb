#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph track lines SEQUENCE`, which tracks lines through a sequence.
void add_lines_track_command(CLI::App& track);

}  // namespace placegraph::apps
