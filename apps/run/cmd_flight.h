#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph hover DIR --out DIR`: where a small flying robot was, from its camera, its inertial
/// sensor and markers.
void add_flight_command(CLI::App& flight);

}  // namespace placegraph::apps
