#pragma once

namespace CLI {
class App;
}

namespace placegraph::apps {

void add_scene_orientation_command(CLI::App& scene);

}  // namespace placegraph::apps
