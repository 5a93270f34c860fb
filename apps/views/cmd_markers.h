#pragma once
namespace CLI {
class App;
}

namespace placegraph::apps {

/// `placegraph markers`: square markers of an image, and where they are.
void add_markers_command(CLI::App& image);

}  // namespace placegraph::apps
