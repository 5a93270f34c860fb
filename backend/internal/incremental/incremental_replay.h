#pragma once
#include <placegraph/backend/incremental/incremental_optimizer.h>

#include <functional>

namespace placegraph {

struct IncrementalReplay {
  Outcome outcome;
  PoseGraph graph;     ///< with the final poses; nodes and constraints in the order of the input
  double cost = 0;     ///< sum of rho(e^T Omega e)
  int iterations = 0;  ///< of all steps
  int solved_from_scratch = 0;  ///< steps
  /// CPU time of the calling thread per step [ms]; the last one includes finish().
  std::vector<double> step_cpu_ms;
  double step_cpu_ms_mean = 0, step_cpu_ms_p95 = 0, step_cpu_ms_max = 0;
};

/// Feeds a graph to an IncrementalOptimizer as if it grew: nodes in the order of their ids, with
/// each the constraints whose other node is there already. `watch`, if there is one, is called
/// after every step (outside the time that is taken) with the number of steps done. Throws as
/// PoseGraph::check.
[[nodiscard]] IncrementalReplay optimize_incrementally(
    const PoseGraph& graph, const IncrementalOptions& options = {},
    const std::function<void(int, const IncrementalOptimizer&)>& watch = {});

}  // namespace placegraph
