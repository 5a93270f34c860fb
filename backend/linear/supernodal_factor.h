#pragma once
#include <placegraph/backend/linear/block_columns.h>

#include <Eigen/Core>
#include <memory>

namespace placegraph {

/// Cholesky factor of a block-sparse matrix by CHOLMOD's supernodal method.
/// It uses dense kernels of BLAS, for factors with much fill. The matrix is in the order of
/// elimination and in postorder. This class only converts the blocks to CHOLMOD's factorization and
/// back. That part of CHOLMOD is under the GPL: without it (PLACEGRAPH_GPL=OFF) ScalarFactor
/// replaces this class.
class SupernodalFactor {
 public:
  /// `matrix` must outlive the factor and keep its pattern; its values may change.
  explicit SupernodalFactor(const BlockPanels& matrix);
  ~SupernodalFactor();

  /// False if the matrix is not positive definite.
  [[nodiscard]] bool factorize();
  /// Solves in place, column by column, in the order of the matrix.
  void solve(Eigen::Ref<Eigen::MatrixXd> x);
  Eigen::VectorXd pivots() const;  ///< diagonal of L
  BlockFactor blocks() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace placegraph
