#pragma once
#include <placegraph/backend/linear/block_columns.h>

#include <Eigen/Core>

namespace placegraph {

/// Cholesky factor of a block-sparse matrix whose fill is too sparse for BLAS.
/// Left-looking, by columns of blocks, with a kernel for each block size (1, 2, 3, 6, 7). The
/// matrix is in the order of elimination. The kernels use the instructions of the processor, so
/// bits may differ between processors, but not between runs. The native solver, which uses it,
/// takes 5.4 ms of CPU time for intel (Ceres with CHOLMOD: 20 ms) and 21 ms for M3500 (60 ms); see
/// docs/results/pose_graphs.md.
class SimplicialFactor {
 public:
  explicit SimplicialFactor(const BlockPanels& matrix);
  static bool has_kernel(int block_size);

  /// False if the matrix is not positive definite.
  [[nodiscard]] bool factorize(const BlockPanels& matrix);
  /// Solves in place, column by column, in the order of the matrix.
  void solve(Eigen::Ref<Eigen::MatrixXd> x) const;
  Eigen::VectorXd pivots() const;  ///< diagonal of L
  const BlockFactor& blocks() const { return factor_; }

 private:
  int block_size_;
  BlockFactor factor_;
  std::vector<int> place_, list_, link_, next_block_;  // workspace of the factorization
};

}  // namespace placegraph
