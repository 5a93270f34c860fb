#pragma once
#include <placegraph/backend/internal/initialization/certificate.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// What `optimize` is asked to do.
struct GraphTask {
  PoseGraphOptions options;
  bool split = false;        ///< the components, one after the other
  bool incremental = false;  ///< as if the graph grew pose by pose
  bool certify = false;      ///< prove how good the solution is, too
};

/// What `optimize` found, and what it cost from the parsed graph to the solution.
struct GraphSolution {
  PoseGraph graph;
  int components = 1;
  int iterations = 0;
  std::string start;  ///< the one that was kept; of several components the dearest
  bool refined_from_certified = false;     ///< every component
  std::vector<RejectedEdge> rejected;      ///< in the order of graph.constraints
  std::vector<double> chi2_by_constraint;  ///< in the order of graph.constraints; incremental: none
  bool loops_judged = true;  ///< false: in a component too few loops to know the noise's scale
  FreeDirections free;       ///< of all components together
  std::vector<double> step_cpu_ms;  ///< incremental: of every pose
  double cpu_ms = 0, wall_ms = 0, peak_mb = 0;
  std::optional<ChordalIsotropicCertificate> certificate;  ///< its cost is not in the times
  double certificate_cpu_ms = 0;
};

/// Throws NoAnswer where the graph or a component has no solution, ArgumentError as
/// optimize_pose_graph.
GraphSolution solve(PoseGraph graph, const GraphTask& task, const LogSink& log);

}  // namespace placegraph::apps
