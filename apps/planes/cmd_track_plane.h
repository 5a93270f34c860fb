#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph track-plane DIR --template x1,y1,...,y4 --out FILE`: follows a planar region through
/// a sequence.
void add_track_plane_command(CLI::App& track);

}  // namespace placegraph::apps
