#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph image two-view-planes MATCHES.txt --out LABELS.txt`.
/// It labels matched points by their planes.
void add_two_view_planes_command(CLI::App& image);

}  // namespace placegraph::apps
