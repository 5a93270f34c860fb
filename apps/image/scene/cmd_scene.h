#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph image orientation`, `surfaces`, `labels` and `popup`.
void add_scene_commands(CLI::App& image);

}  // namespace placegraph::apps
