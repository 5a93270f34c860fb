#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph image flow FROM TO`, which estimates the optical flow.
void add_flow_command(CLI::App& image);

}  // namespace placegraph::apps
