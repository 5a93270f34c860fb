#pragma once
#include <placegraph/backend/linear/block_columns.h>

#include <Eigen/Core>
#include <memory>

namespace placegraph {

/// Scalar Cholesky factor of a block-sparse matrix, by Eigen's simplicial method.
/// It replaces SupernodalFactor, with the same interface, if the GPL parts of CHOLMOD are left out
/// (PLACEGRAPH_GPL=OFF). It supports every block size and is slower. The matrix is in the order of
/// elimination.
class ScalarFactor {
 public:
  /// `matrix` must outlive the factor and keep its pattern; its values may change.
  explicit ScalarFactor(const BlockPanels& matrix);
  ~ScalarFactor();

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
