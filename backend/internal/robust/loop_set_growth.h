#pragma once
#include <placegraph/backend/internal/robust/gnc.h>
#include <placegraph/backend/internal/robust/loop_clusters.h>
#include <placegraph/backend/pose_graph/pose_graph_options.h>

namespace placegraph {

struct LoopSetGrowth {
  LocalSolution local;
  double noise_scale = 1;  ///< variance of the noise in units of what the information claims
};

/// Finds which loops of a graph are true, and the poses that go with them. Weights of the loops
/// come out as 1 or 0. After Latif et al. 2013 ("Robust loop closing over time for pose graph
/// SLAM"), with groups of loops that support each other (loop_support.h) in the place of their
/// clusters:
///   1. begin with odometry alone and the largest group,
///   2. solve; of the groups at least half as large take those that the graph can follow (the rise
///      of the cost, loop_leverage.h, is within the gate of each of its loops), by graduated
///      non-convexity over all that is taken; and so on to groups of two,
///   3. test every loop, taken or not, against the solution, and the lone ones against what the
///      solution can follow; solve and repeat until nothing changes.
/// The gate is calibrated to the noise of the graph: of the rings of neighbouring loops at first,
/// of the solution later. `probability` is the share of true loops within it, were noise Gaussian.
/// A loop that alone ties a part of the graph to the rest is kept.
template <class Group>
[[nodiscard]] LoopSetGrowth extend_loop_set(PackedGraph<Group>& graph, const LoopSupport& support,
                                            double probability, const LocalSolverOptions& solver,
                                            const LoopSetGrowthOptions& options,
                                            const GncOptions& gnc);

/// Step 3 alone, from the poses and the weights that `graph` has.
template <class Group>
[[nodiscard]] LoopSetGrowth settle_loops(PackedGraph<Group>& graph, const LoopSupport& support,
                                         double probability, const LocalSolverOptions& solver,
                                         const LoopSetGrowthOptions& options,
                                         const GncOptions& gnc);

}  // namespace placegraph
