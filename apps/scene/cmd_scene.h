#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph scene WHAT`: what a picture shows.
void add_scene_commands(CLI::App& image);

}  // namespace placegraph::apps
