#pragma once
#include <placegraph/backend/pose_graph/pose_graph_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A constraint that was left out of the solution as false.
struct RejectedEdge {
  int constraint = 0;  ///< position in PoseGraph::constraints
  double chi2 = 0;     ///< e^T Omega e at the solution
  /// The first that holds of "inconsistent with odometry": no drift of the odometry explains it,
  /// "pairwise": no loop nearby agrees with it, "residual": its error is beyond the gate.
  std::string reason;
};

/// Directions in which the cost of a graph does not change, to rounding.
/// A minimum with such directions is not the only one.
struct FreeDirections {
  int count = 0;                    ///< their number; kMost stands for as many or more
  std::vector<int> nodes;           ///< positions of the nodes that move along them, ascending
  static constexpr int kMost = 64;  ///< no more are counted
};

/// The result of optimizing a pose graph.
struct PoseGraphReport {
  Outcome outcome;  ///< see optimize_pose_graph
  PoseGraph graph;  ///< with the optimized poses
  /// Sum of e^T Omega e at the given poses, without kernels, by PoseGraphOptions::rotation_error.
  double chi2_initial = 0;
  double chi2_final = 0;  ///< the same at the optimized poses
  int iterations = 0;     ///< steps of all descents together
  PoseGraphInitialization initialization_used =
      PoseGraphInitialization::kFile;      ///< of the descent that was kept; not kAuto
  bool refined_from_certified = false;     ///< whether initialization_used is kCertified
  std::vector<double> chi2_by_constraint;  ///< at the optimized poses, by graph.constraints
  /// Constraints that RobustOptions left out as false, in the order of graph.constraints. The sums
  /// above include them all the same.
  std::vector<RejectedEdge> rejected;
  /// False if there were loops, but too few of them agree to estimate the scale of their noise, so
  /// that none was tested.
  bool loops_judged = true;
  /// Directions that the constraints leave undetermined at the solution: another start may end
  /// elsewhere at the same cost.
  FreeDirections free;
};

}  // namespace placegraph
