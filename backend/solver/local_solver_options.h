#pragma once
#include <placegraph/backend/solver/solver_engine.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/constraint.h>

namespace placegraph {

struct LocalSolverOptions {
  PoseGraphEngine engine = PoseGraphEngine::kNative;
  RotationError rotation_error = RotationError::kLog;
  StepRule step_rule = StepRule::kDogleg;
  int max_iterations = 200;
  double relative_decrease = 1e-9;  ///< stop when the cost falls by less than this share
  LogSink log = {};                 ///< a line for every iteration (kDebug)
};

struct LocalSolution {
  Outcome outcome;
  int iterations = 0;
  double cost_initial = 0, cost_final = 0;  ///< sum of weight * rho(e^T Omega e)
  /// Whether the normal equations were positive definite near the end, so that the minimum is
  /// locally unique. Also false if that was not tested (Ceres).
  bool regular = false;
};

}  // namespace placegraph
