#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// The positional form of `placegraph planes`: CLOUD_OR_DEPTH --out LABELS, the planes of a point
/// cloud. To be called when the subcommands of `planes` are there: it does nothing where one of
/// them was asked for.
void add_planes_command(CLI::App& image);

}  // namespace placegraph::apps
