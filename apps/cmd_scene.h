#pragma once

namespace CLI {
class App;
}

namespace placegraph::apps {

void add_scene_command(CLI::App& app);

}  // namespace placegraph::apps
