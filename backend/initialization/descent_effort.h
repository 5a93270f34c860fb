#pragma once
#include <placegraph/backend/linear/block_cholesky.h>

namespace placegraph {

/// Effort of computations on a lifted chordal problem (LiftedProblem).
/// The unit is one Gauss-Newton iteration on the pose graph itself. Operations are counted, not
/// timed, so that the same input gives bitwise identical results.
class DescentEffort {
 public:
  /// `dim`: dimension of space, 2 or 3; `ordering`: order of the graph's blocks, for any block
  /// size.
  DescentEffort(int dim, int nodes, std::size_t edges, const BlockOrdering& ordering);

  /// Effort of a step of the descent at this rank, with the given number of products with the
  /// Hessian.
  double step(int rank, int products) const;
  /// Effort of these numbers of factorizations of the certificate's matrix and solutions with it.
  double certificate(int factorizations, int solutions) const;

 private:
  double factorization_operations(int block) const;
  double solution_operations(int block) const;
  double iteration_operations() const;
  int lifted_block(int rank) const;
  double product_operations(int rank) const;
  double step_operations(int rank) const;

  int dim_, nodes_;
  double edges_;
  double factor_operations_, factor_fill_;  // for blocks of size one
};

}  // namespace placegraph
