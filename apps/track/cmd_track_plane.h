#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph track plane DIR --template x1,y1,...,y4 --out FILE`.
/// It tracks a planar region through a sequence.
void add_track_plane_command(CLI::App& track);

}  // namespace placegraph::apps
