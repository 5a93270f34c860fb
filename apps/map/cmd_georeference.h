#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph georeference GRAPH --gps OXTS --out DIR`: a map put onto the earth.
void add_georeference_command(CLI::App& map);

}  // namespace placegraph::apps
