#pragma once
#include <placegraph/backend/initialization/certificate.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Task of the solver of `optimize`.
struct GraphTask {
  PoseGraphOptions options;
  bool split = false;        ///< accept a graph of components that nothing ties to each other
  bool incremental = false;  ///< solve an incremental graph, pose by pose
  bool certify = false;      ///< also certify the solution
};

/// Solution of `optimize` and its cost in time, from the parsed graph to the solution.
struct GraphSolution {
  PoseGraph graph;
  int components = 1;
  int degrees_of_freedom = 0;  ///< of the constraints that were not rejected
  int iterations = 0;
  std::string initialization;  ///< initialization that was used; of several components the most
                               ///< expensive one
  bool refined_from_certified = false;     ///< whether `initialization` is certified
  std::vector<RejectedEdge> rejected;      ///< in the order of graph.constraints
  std::vector<double> chi2_by_constraint;  ///< in the order of graph.constraints
  bool loops_judged =
      true;  ///< false if a component has too few loops to estimate the scale of the noise
  FreeDirections free;              ///< free directions of all components together
  std::vector<Doubt> doubts;        ///< what speaks against the solution
  std::vector<double> step_cpu_ms;  ///< incremental only: time of every pose
  double cpu_ms = 0, wall_ms = 0, peak_mb = 0;
  std::optional<ChordalIsotropicCertificate>
      certificate;  ///< its computation is not part of the times
  double certificate_cpu_ms = 0;
};

/// Optimizes a pose graph.
/// Throws NoResult if the graph or a component has no solution, and ArgumentError like
/// optimize_pose_graph.
GraphSolution solve(PoseGraph graph, const GraphTask& task, const LogSink& log);

}  // namespace placegraph::apps
