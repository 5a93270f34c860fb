#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/pose_graph/constraint.h>

namespace [[gnu::visibility("default")]] placegraph {

/// How near to the minimum an IncrementalOptimizer stays.
struct IncrementalOptions {
  RotationError rotation_error = RotationError::kLog;  ///< of relative poses
  /// Iterate until the cost is predicted to be above its minimum by no more than this share
  /// (iterations begin somewhat earlier).
  double excess = 5e-3;
  double final_excess = 1e-8;  ///< the same of finish()
  /// An edge is linearized again when its Jacobian has changed by this share of its norm.
  double relinearization = 0.2;
  int max_iterations = 20;  ///< of a step, before the whole graph is solved from scratch
  void check() const;
};
void visit(OptionVisitor& field, IncrementalOptions& options);

}  // namespace placegraph
