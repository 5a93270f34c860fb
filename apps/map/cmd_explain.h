#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph explain`: what a map knows of one frame.
void add_explain_command(CLI::App& map);

}  // namespace placegraph::apps
