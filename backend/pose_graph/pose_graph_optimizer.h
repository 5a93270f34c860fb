#pragma once
#include <placegraph/backend/pose_graph/initialization_selection.h>
#include <placegraph/backend/pose_graph/robust_optimizer.h>
#include <placegraph/backend/solver/free_directions.h>

namespace placegraph {

struct PoseGraphOptions {
  RotationError rotation_error = RotationError::kLog;
  PoseGraphEngine engine = PoseGraphEngine::kNative;
  StepRule step_rule = StepRule::kDogleg;
  /// kAuto: with `robust` the poses as they are (with gnc those of the odometry), because false
  /// loops spoil the other starts.
  PoseGraphStart start = PoseGraphStart::kAuto;
  int max_iterations = 200;
  double relative_decrease = 1e-9;  ///< stop when the cost falls by less than this share
  RobustOptions robust = {};        ///< what is done against false loops
  void check() const;
};
void visit(OptionVisitor& field, PoseGraphOptions& options);

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

/// Minimizes sum rho(e^T Omega e) over the nodes that are not fixed, leaving out what
/// `options.robust` finds to be false; if a connected component has
/// no fixed node its first one is held. SE(2), SE(3) and Sim(3) graphs. Throws as PoseGraph::check.
[[nodiscard]] PoseGraphReport optimize_pose_graph(PoseGraph graph, const PoseGraphOptions& options,
                                                  const LogSink& log = {});

/// Sum of e^T Omega e over all relative-pose constraints (and positions), without kernels.
double chi2(const PoseGraph& graph, RotationError rotation_error);

}  // namespace placegraph
