#pragma once

namespace CLI {
class App;
}

namespace placegraph::apps {

/// `placegraph map semantic`: what is where in the streets of a saved map.
void add_map_street_command(CLI::App& map);

}  // namespace placegraph::apps
