#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/pose_graph/constraint.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Accuracy and iterations of an IncrementalOptimizer.
struct IncrementalOptions {
  RotationError rotation_error = RotationError::kLog;  ///< error of relative poses
  /// Maximum predicted excess of the cost over its minimum, as a share of the cost, at which the
  /// iterations stop (they start at a somewhat smaller excess).
  double excess = 5e-3;
  double final_excess = 1e-8;  ///< the same for finish()
  /// Relative change of an edge's Jacobian at which it is linearized again.
  double relinearization = 0.2;
  int max_iterations = 20;  ///< iterations of a step before the graph is solved from scratch
  void check() const;
};
void visit(OptionVisitor& field, IncrementalOptions& options);

}  // namespace placegraph
