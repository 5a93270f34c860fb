#pragma once
namespace CLI {
class App;
}

namespace placegraph::apps {

/// `placegraph vanishing`: in which directions the edges of a scene point.
void add_vanishing_command(CLI::App& image);

}  // namespace placegraph::apps
