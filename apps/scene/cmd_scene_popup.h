#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph scene popup IMAGE --out FILE.ply`: a picture folded up into space, and things put
/// into it.
void add_image_popup_command(CLI::App& image);

}  // namespace placegraph::apps
