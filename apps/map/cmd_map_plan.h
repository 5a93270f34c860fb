#pragma once

namespace CLI {
class App;
}

namespace placegraph::apps {

/// Adds `placegraph map plan MAP --out DIR`, which draws the floor plan of a saved map.
void add_map_plan_command(CLI::App& map);

}  // namespace placegraph::apps
