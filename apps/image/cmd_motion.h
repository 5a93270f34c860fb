#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph image motion MATCHES`, which estimates the motion between two views.
void add_motion_command(CLI::App& image);

}  // namespace placegraph::apps
