#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph scene WHAT`: what a picture shows.
void add_scene_command(CLI::App& app);

}  // namespace placegraph::apps
