#pragma once

namespace CLI {
class App;
}

namespace placegraph::apps {

/// Adds `placegraph map street MAP --out DIR`, which makes the street map.
void add_map_street_command(CLI::App& map);

}  // namespace placegraph::apps
