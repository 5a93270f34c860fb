#pragma once
#include <placegraph/backend/incremental/incremental_optimizer.h>

#include <functional>

namespace [[gnu::visibility("default")]] placegraph {

/// A graph that was solved pose by pose.
struct IncrementalReplay {
  Outcome outcome;
  PoseGraph graph;  ///< graph with the final poses; nodes and constraints in the order of the input
  double cost = 0;  ///< sum of rho(e^T Omega e)
  int iterations = 0;           ///< sum over all steps
  int solved_from_scratch = 0;  ///< number of steps solved from scratch
  /// CPU time of the calling thread per step [ms]; the last one includes finish().
  std::vector<double> step_cpu_ms;
  double step_cpu_ms_mean = 0, step_cpu_ms_p95 = 0, step_cpu_ms_max = 0;
};

/// Adds a graph to an IncrementalOptimizer node by node.
/// Nodes are in the order of their ids; each is added with the constraints to earlier nodes.
/// `watch`, if set, is called after every step (outside the measured time) with the number of
/// completed steps. Throws as PoseGraph::check.
[[nodiscard]] IncrementalReplay optimize_incrementally(
    const PoseGraph& graph, const IncrementalOptions& options = {},
    const std::function<void(int, const IncrementalOptimizer&)>& watch = {});

}  // namespace placegraph
