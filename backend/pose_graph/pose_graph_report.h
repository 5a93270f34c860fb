#pragma once
#include <placegraph/backend/pose_graph/pose_graph_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A constraint that was left out of the solution.
struct RejectedEdge {
  int constraint = 0;  ///< position in PoseGraph::constraints
  double chi2 = 0;     ///< e^T Omega e at the solution
  /// The first that holds of "inconsistent with odometry": no drift of the odometry explains it,
  /// "pairwise": no loop nearby agrees with it, "residual": its error lies beyond the gate.
  std::string reason;
};

/// Directions in which the cost of a graph does not change, to rounding, from where its poses are:
/// a minimum there is not the only one.
struct FreeDirections {
  int count = 0;           ///< kMost stands for as many or more
  std::vector<int> nodes;  ///< positions of the nodes that move along them, ascending
  static constexpr int kMost = 64;
};

struct PoseGraphReport {
  Outcome outcome;
  PoseGraph graph;  ///< with the optimized poses
  /// Sum of e^T Omega e in the chosen convention at the poses that were given, without kernels.
  double chi2_initial = 0;
  double chi2_final = 0;
  int iterations = 0;
  PoseGraphStart start_used = PoseGraphStart::kFile;  ///< never kAuto
  bool refined_from_certified = false;                ///< start_used == kCertified
  std::vector<double> chi2_by_constraint;             ///< final, in the order of graph.constraints
  /// Left out of the solution as false, by RobustOptions; in the order of graph.constraints. The
  /// sums above count them all the same.
  std::vector<RejectedEdge> rejected;
  /// False: there were loops, but too few of them agree to know the noise's scale, so that none was
  /// judged.
  bool loops_judged = true;
  /// Directions that the constraints leave open at the solution, and the nodes that move along
  /// them: another start may end elsewhere at the same cost.
  FreeDirections free;
};

}  // namespace placegraph
