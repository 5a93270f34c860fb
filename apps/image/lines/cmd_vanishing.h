#pragma once
namespace CLI {
class App;
}

namespace placegraph::apps {

/// Adds `placegraph image vanishing LINES`, which finds vanishing points.
void add_vanishing_command(CLI::App& image);

}  // namespace placegraph::apps
