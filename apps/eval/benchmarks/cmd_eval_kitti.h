#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph eval kitti TRUTHS ESTIMATES...`.
/// It judges submissions to KITTI's odometry benchmark.
void add_eval_kitti_command(CLI::App& eval_group);

}  // namespace placegraph::apps
