#pragma once
#include <placegraph/backend/robust/gnc.h>
#include <placegraph/backend/robust/loop_clusters.h>
#include <placegraph/backend/robust/robust_options.h>

namespace placegraph {

struct LoopSetGrowth {
  LocalSolution local;
  double noise_scale = 1;  ///< variance of the noise relative to the information
};

/// Finds the true loops of a graph and the poses optimized with them.
/// On return the weights of the loops are 1 or 0. After Latif et al. 2013 ("Robust loop closing
/// over time for pose graph SLAM"), with groups of loops that support each other (loop_clusters.h)
/// instead of their clusters:
///   1. start with odometry and the largest group,
///   2. solve; of the groups at least half as large accept those to which the graph can adapt (the
///      rise of the cost, loop_leverage.h, is within the gate of each of its loops), by graduated
///      non-convexity over all accepted loops; repeat down to groups of two,
///   3. test every loop, accepted or not, against the solution, and the rejected ones by the rise
///   of
///      the cost that they would cause; solve and repeat until the set is constant.
/// The gate is calibrated to the noise of the graph: initially to that of the rings of neighbouring
/// loops, later to that of the solution. `probability` is the share of true loops within the gate
/// for Gaussian noise. A loop that is the only connection of a part of the graph to the rest is
/// kept.
template <class Group>
[[nodiscard]] LoopSetGrowth extend_loop_set(PackedGraph<Group>& graph, const LoopSupport& support,
                                            double probability, const LocalSolverOptions& solver,
                                            const LoopSetGrowthOptions& options,
                                            const GncOptions& gnc);

/// Step 3 only, from the poses and the weights of `graph`.
template <class Group>
[[nodiscard]] LoopSetGrowth settle_loops(PackedGraph<Group>& graph, const LoopSupport& support,
                                         double probability, const LocalSolverOptions& solver,
                                         const LoopSetGrowthOptions& options,
                                         const GncOptions& gnc);

}  // namespace placegraph
