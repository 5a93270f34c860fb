#pragma once

namespace CLI {
class App;
}

namespace placegraph::apps {

/// `placegraph map plan`: the floor plan of a saved map.
void add_map_plan_command(CLI::App& map);

}  // namespace placegraph::apps
