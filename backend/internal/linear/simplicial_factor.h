#pragma once
#include <placegraph/backend/internal/linear/block_columns.h>

#include <Eigen/Core>

namespace placegraph {

/// Cholesky factor of a block-sparse matrix whose fill is too thin for BLAS: left-looking, column
/// of blocks by column of blocks, with a kernel for each block size (1, 2, 3, 6, 7). The matrix
/// stands in the order of elimination. The kernels make use of what instructions the processor has,
/// so bits may differ between processors, but not between runs. The native solver,
/// which rests on it, takes 5.4 ms of CPU for intel where Ceres with CHOLMOD takes 20, and 21 for
/// M3500 where that takes 60 (docs/results.md, pose graphs).
class SimplicialFactor {
 public:
  explicit SimplicialFactor(const BlockPanels& matrix);
  static bool has_kernel(int block_size);

  /// False if the matrix is not positive definite.
  [[nodiscard]] bool factorize(const BlockPanels& matrix);
  /// In place, column by column, ordered as the matrix.
  void solve(Eigen::Ref<Eigen::MatrixXd> x) const;
  Eigen::VectorXd pivots() const;  ///< diagonal of L
  const BlockFactor& blocks() const { return factor_; }

 private:
  int block_size_;
  BlockFactor factor_;
  std::vector<int> place_, list_, link_, next_block_;  // workspace of the factorization
};

}  // namespace placegraph
