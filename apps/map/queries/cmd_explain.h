#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph map explain MAP FRAME`, which explains the pose of one frame.
void add_explain_command(CLI::App& map);

}  // namespace placegraph::apps
