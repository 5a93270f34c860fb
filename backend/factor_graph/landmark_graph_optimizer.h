#pragma once
#include <placegraph/backend/factor_graph/factor_graph.h>
#include <placegraph/backend/factor_graph/factor_graph_options.h>
#include <placegraph/backend/pose_graph/pose_graph_report.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/constraint.h>
#include <placegraph/graph/pose_graph/landmark_graph.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The result of optimizing a landmark graph.
struct LandmarkGraphReport {
  Outcome outcome;                          ///< outcome, as of optimize_pose_graph
  LandmarkGraph graph;                      ///< graph with the estimate
  double chi2_initial = 0, chi2_final = 0;  ///< sum of e^T Omega e
  int iterations = 0;                       ///< number of steps
  /// Undetermined directions at the solution; in `nodes`, point i has the number (number of nodes)
  /// + i.
  FreeDirections free;
  int degrees_of_freedom = 0;  ///< expectation of chi2_final
  /// What speaks against the result: a chi2 far from its expectation, directions that are free,
  /// components without a reference.
  std::vector<Doubt> doubts;
};

/// Minimizes the sum of e^T Omega e over poses and points, from their current values.
/// The sum is over edges, measured positions, priors and observations. In a connected component
/// without a fixed node or point, prior or measured position, the first node is held. Throws as
/// LandmarkGraph::check. The log receives a line for every step.
[[nodiscard]] LandmarkGraphReport optimize_landmark_graph(LandmarkGraph graph,
                                                          const LandmarkGraphOptions& options,
                                                          const LogSink& log_sink = {});

/// Sum of e^T Omega e over edges, measured positions, priors and observations.
/// Kernels are left out. Throws as LandmarkGraph::check.
double chi2(const LandmarkGraph& graph, RotationError rotation_error);

/// Converts a landmark graph to a factor graph.
/// The variables are the nodes, then the points; the terms are those of the pose graph, then priors
/// and observations. The fixed variables and the nodes that optimize_landmark_graph would hold are
/// held. Throws as LandmarkGraph::check.
FactorGraph to_factor_graph(const LandmarkGraph& graph, RotationError rotation_error);

/// Id of a variable of `to_factor_graph`: of a node, or behind the nodes of a point.
NodeId id_of(const LandmarkGraph& graph, int variable);

/// Number of connected components; a point that no node observes is not counted.
int count_components(const LandmarkGraph& graph);
/// Positions of the nodes that are held because their component has no other reference.
std::vector<int> held_for_want_of_a_tie(const LandmarkGraph& graph);

}  // namespace placegraph
