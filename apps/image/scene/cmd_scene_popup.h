#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph image popup IMAGE --out FILE.ply`.
/// It makes a 3D model of planes from one image and inserts a box.
void add_image_popup_command(CLI::App& image);

}  // namespace placegraph::apps
