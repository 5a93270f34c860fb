#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph lines track SEQUENCE`: follows lines through a sequence and counts.
void add_lines_track_command(CLI::App& track);

}  // namespace placegraph::apps
