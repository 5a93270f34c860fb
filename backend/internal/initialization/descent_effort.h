#pragma once
#include <placegraph/backend/internal/linear/block_cholesky.h>

namespace placegraph {

/// What work on a lifted chordal problem (LiftedProblem) costs, as a multiple of one Gauss-Newton
/// iteration on the pose graph itself. Operations are counted, not timed, so that the same input
/// gives the same bits.
class DescentEffort {
 public:
  /// `dim`: of space, 2 or 3; `ordering`: of the graph's blocks, which serves any block size.
  DescentEffort(int dim, int nodes, std::size_t edges, const BlockOrdering& ordering);

  /// Of a step of the descent at this rank, with so many products with the Hessian inside.
  double step(int rank, int products) const;
  /// Of so many factorizations of the certificate's matrix and solutions with it.
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
  double factor_operations_, factor_fill_;  // of blocks of one number
};

}  // namespace placegraph
