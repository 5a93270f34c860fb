#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph planes two-view MATCHES.txt --out LABELS.txt`: the planes behind matched points.
void add_planes_command(CLI::App& app);

}  // namespace placegraph::apps
