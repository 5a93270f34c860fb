#pragma once
#include <placegraph/backend/factor_graph/factor_graph.h>
#include <placegraph/backend/factor_graph/factor_graph_options.h>
#include <placegraph/backend/pose_graph/pose_graph_report.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/constraint.h>
#include <placegraph/graph/pose_graph/landmark_graph.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The result of optimizing a landmark graph.
struct LandmarkGraphReport {
  Outcome outcome;                          ///< as of optimize_pose_graph
  LandmarkGraph graph;                      ///< with the estimate
  double chi2_initial = 0, chi2_final = 0;  ///< sum of e^T Omega e
  int iterations = 0;                       ///< steps
  /// Directions that are undetermined at the solution; among its nodes, point i has the number
  /// (number of nodes) + i.
  FreeDirections free;
};

/// Minimizes the sum of e^T Omega e over poses and points, from their present values.
/// The sum is over edges, measured positions, priors and observations. Of a connected component
/// without a fixed node or point, prior or measured position the first node is held. Throws as
/// LandmarkGraph::check.
[[nodiscard]] LandmarkGraphReport optimize_landmark_graph(LandmarkGraph graph,
                                                          const LandmarkGraphOptions& options);

/// Sum of e^T Omega e over edges, measured positions, priors and observations.
/// Kernels are left out. Throws as LandmarkGraph::check.
double chi2(const LandmarkGraph& graph, RotationError rotation_error);

/// A landmark graph as a factor graph.
/// Variables are the nodes, then the points; terms those of the pose graph, then priors and
/// observations. Held are the fixed ones and the nodes that optimize_landmark_graph would hold.
/// Throws as LandmarkGraph::check.
FactorGraph to_factor_graph(const LandmarkGraph& graph, RotationError rotation_error);

/// Number of connected components; a point that no node observes is none.
int count_components(const LandmarkGraph& graph);
/// Positions of the nodes that are held because nothing determines where their component is.
std::vector<int> held_for_want_of_a_tie(const LandmarkGraph& graph);

}  // namespace placegraph
