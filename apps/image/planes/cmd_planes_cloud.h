#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph image planes CLOUD_OR_DEPTH --out LABELS`, which finds planes in a point cloud.
void add_planes_command(CLI::App& image);

}  // namespace placegraph::apps
