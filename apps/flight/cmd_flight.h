#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph flight run FLIGHT --out DIR`, which estimates the states of a flying robot.
void add_flight_command(CLI::App& flight);

}  // namespace placegraph::apps
