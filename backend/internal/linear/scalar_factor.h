#pragma once
#include <placegraph/backend/internal/linear/block_columns.h>

#include <Eigen/Core>
#include <memory>

namespace placegraph {

/// Cholesky factor of a block-sparse matrix, scalar by scalar, by Eigen's simplicial method. It
/// takes the place of SupernodalFactor, with the same interface, where the parts of CHOLMOD that
/// are under the GPL are left out (PLACEGRAPH_GPL=OFF); it serves every size of blocks and is
/// slower. The matrix stands in the order of elimination.
class ScalarFactor {
 public:
  /// `matrix` must outlive the factor and keep its pattern; its values may change.
  explicit ScalarFactor(const BlockPanels& matrix);
  ~ScalarFactor();

  /// False if the matrix is not positive definite.
  [[nodiscard]] bool factorize();
  /// In place, column by column, ordered as the matrix.
  void solve(Eigen::Ref<Eigen::MatrixXd> x);
  Eigen::VectorXd pivots() const;  ///< diagonal of L
  BlockFactor blocks() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace placegraph
