#pragma once
namespace CLI {
class App;
}

namespace placegraph::apps {

/// Adds `placegraph image markers IMAGE`, which detects markers and estimates their poses.
void add_markers_command(CLI::App& image);

}  // namespace placegraph::apps
