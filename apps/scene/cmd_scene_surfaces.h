#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph scene surfaces INPUT --out DIR`: sky 0, ground 1, vertical 2 and object 3.
void add_image_surfaces_command(CLI::App& image);

}  // namespace placegraph::apps
