#pragma once
#include <placegraph/backend/pose_graph/pose_graph_options.h>
#include <placegraph/backend/solver/free_directions.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A constraint that was classified as false and left out of the solution.
struct RejectedEdge {
  int constraint = 0;  ///< position in PoseGraph::constraints
  double chi2 = 0;     ///< e^T Omega e at the solution
  /// The first reason that applies: "inconsistent with odometry": no drift of the odometry explains
  /// the constraint; "pairwise": no loop nearby agrees with it; "residual": its error exceeds the
  /// gate.
  std::string reason;
};

/// The result of optimizing a pose graph.
struct PoseGraphReport {
  Outcome outcome;  ///< outcome, see optimize_pose_graph
  PoseGraph graph;  ///< graph with the optimized poses
  /// Sum of e^T Omega e at the input poses over the constraints that were not rejected, without
  /// kernels, with PoseGraphOptions::rotation_error.
  double chi2_initial = 0;
  double chi2_final = 0;       ///< the same at the optimized poses
  int degrees_of_freedom = 0;  ///< expectation of chi2_final, of the same constraints
  int iterations = 0;          ///< total number of steps of all descents
  /// Initialization of the selected descent, of several components the most expensive one; never
  /// kAuto.
  PoseGraphInitialization initialization_used = PoseGraphInitialization::kFile;
  bool refined_from_certified = false;     ///< whether initialization_used is kCertified
  std::vector<double> chi2_by_constraint;  ///< at the optimized poses, as graph.constraints
  /// Constraints classified as false, in the order of graph.constraints.
  std::vector<RejectedEdge> rejected;
  /// False if a component has loops, but too few of them agreed to estimate the scale of their
  /// noise, so that none of them was tested.
  bool loops_judged = true;
  /// Directions that the constraints leave undetermined at the solution: another initialization may
  /// lead to other poses of the same cost.
  FreeDirections free;
  std::vector<Doubt> doubts;  ///< what speaks against the result, see doubts_of
};

/// What speaks against a result that has an estimate.
///
/// A chi2 far from its expectation, directions that are free, and loops that were not judged do.
/// optimize_pose_graph fills `doubts` with it.
/// `method` is the robust method that was used. A chi2 that rounding of the measurements explains,
/// by the digits that they have, is not doubted.
std::vector<Doubt> doubts_of(const PoseGraphReport& report, RobustMethod method);

/// The graph without the constraints that were rejected, in the same order.
PoseGraph without_rejected(PoseGraph graph, const std::vector<RejectedEdge>& rejected);

}  // namespace placegraph
