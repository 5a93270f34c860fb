#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph convert IN OUT`: trajectories between KITTI, TUM and EuRoC form, g2o normalized.
void add_convert_command(CLI::App& graph);

}  // namespace placegraph::apps
