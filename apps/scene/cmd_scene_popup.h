#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph scene popup IMAGE --out FILE.ply`: a picture folded up into space, and things put
/// into it.
void add_scene_popup_command(CLI::App& scene);

}  // namespace placegraph::apps
