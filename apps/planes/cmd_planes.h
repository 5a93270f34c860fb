#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph planes CLOUD --out LABELS`: the planes of a point cloud (cmd_planes_cloud.h), and
/// `placegraph planes two-view MATCHES.txt --out LABELS.txt`: the planes behind matched points.
void add_two_view_planes_command(CLI::App& image);

}  // namespace placegraph::apps
