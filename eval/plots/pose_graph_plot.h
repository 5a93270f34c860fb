#pragma once
#include <placegraph/eval/plots/plot.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace placegraph {

/// A pose graph before (grey) and after its optimization, lines along odometry, loops
/// and rejected constraints as links of the optimized poses. Both graphs have the same nodes and
/// constraints; `rejected` are positions among the constraints.
Plot plot_of(const PoseGraph& before, const PoseGraph& after, const std::vector<int>& rejected);

}  // namespace placegraph
