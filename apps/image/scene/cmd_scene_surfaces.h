#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph image surfaces INPUT --out DIR`.
/// It labels pixels as sky 0, ground 1, vertical 2 or object 3.
void add_image_surfaces_command(CLI::App& image);

}  // namespace placegraph::apps
