#pragma once

namespace CLI {
class App;
}

namespace placegraph::apps {

void add_image_orientation_command(CLI::App& image);

}  // namespace placegraph::apps
