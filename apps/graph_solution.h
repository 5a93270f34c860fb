#pragma once
#include <placegraph/backend/pose_graph_optimizer.h>

#include <vector>

namespace placegraph::apps {

/// What `optimize` is asked to do.
struct GraphTask {
  PoseGraphOptions options;
  bool split = false;        ///< the components, one after the other
  bool incremental = false;  ///< as if the graph grew pose by pose
};

/// What `optimize` found, and what it cost from the parsed graph to the solution.
struct GraphSolution {
  PoseGraph graph;
  int components = 1;
  int iterations = 0;
  std::vector<RejectedEdge> rejected;  ///< in the order of graph.constraints
  std::vector<double> step_cpu_ms;     ///< incremental: of every pose
  double cpu_ms = 0, wall_ms = 0, peak_mb = 0;
};

/// Throws NoAnswer where the graph or a component has no solution, ArgumentError as
/// optimize_pose_graph.
GraphSolution solve(PoseGraph graph, const GraphTask& task, const LogSink& log);

}  // namespace placegraph::apps
