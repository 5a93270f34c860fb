#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph map georeference MAP --gps OXTS --out DIR`, which places a map on the earth.
void add_georeference_command(CLI::App& map);

}  // namespace placegraph::apps
