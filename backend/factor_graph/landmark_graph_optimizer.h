#pragma once
#include <placegraph/backend/factor_graph/factor_graph.h>
#include <placegraph/backend/factor_graph/factor_graph_options.h>
#include <placegraph/backend/pose_graph/pose_graph_report.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/constraint.h>
#include <placegraph/graph/pose_graph/landmark_graph.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

struct LandmarkGraphReport {
  Outcome outcome;
  LandmarkGraph graph;                      ///< with the estimate
  double chi2_initial = 0, chi2_final = 0;  ///< sum of e^T Omega e
  int iterations = 0;
  /// Directions that are open at the solution; its nodes count the points on behind the nodes.
  FreeDirections free;
};

/// Minimizes the sum of e^T Omega e over edges, measured positions, priors and sights from where
/// poses and points are. A connected part that no fixed node or point, prior or measured position
/// ties to the world keeps its first node. Throws as LandmarkGraph::check.
[[nodiscard]] LandmarkGraphReport optimize_landmark_graph(LandmarkGraph graph,
                                                          const LandmarkGraphOptions& options);

/// Sum of e^T Omega e over all of it. Throws as LandmarkGraph::check.
double chi2(const LandmarkGraph& graph, RotationError rotation_error);

/// As a factor graph: the nodes, then the points; the terms of the pose graph, then priors and
/// sights. Held are the fixed ones, and nodes as above.
FactorGraph to_factor_graph(const LandmarkGraph& graph, RotationError rotation_error);

/// The parts that hang together by edges and sights; points that nobody sees are none.
int count_components(const LandmarkGraph& graph);
/// The nodes that are held only because nothing ties their part to the world, by positions.
std::vector<int> held_for_want_of_a_tie(const LandmarkGraph& graph);

}  // namespace placegraph
