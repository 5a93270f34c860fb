#pragma once
#include <placegraph/backend/pose_graph_optimizer.h>

#include <string>
#include <vector>

namespace placegraph::apps {

/// A constraint that the solution leaves out.
struct RejectedConstraint {
  int constraint = 0;  ///< position in PoseGraph::constraints
  double chi2 = 0;     ///< e^T Omega e at the solution
  std::string reason;
};

/// What `optimize` found, and what it cost from the parsed graph to the solution.
struct GraphSolution {
  PoseGraph graph;
  int components = 1;
  int iterations = 0;
  std::vector<RejectedConstraint> rejected;
  double cpu_ms = 0, wall_ms = 0, peak_mb = 0;
};

/// Optimizes the graph, by its components one after the other if `split`. Throws NoAnswer where one
/// has no solution, ArgumentError as optimize_pose_graph.
GraphSolution solve(PoseGraph graph, bool split, const PoseGraphOptions& options,
                    const LogSink& log);

}  // namespace placegraph::apps
