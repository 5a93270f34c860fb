#pragma once

namespace CLI {
class App;
}

namespace placegraph::apps {

/// Adds `placegraph map import --colmap MODEL --images SEQUENCE --out MAP`.
void add_map_import_command(CLI::App& map);

}  // namespace placegraph::apps
