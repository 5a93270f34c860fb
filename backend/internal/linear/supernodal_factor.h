#pragma once
#include <placegraph/backend/internal/linear/block_columns.h>

#include <Eigen/Core>
#include <memory>

namespace placegraph {

/// Cholesky factor of a block-sparse matrix by CHOLMOD's supernodal method: dense kernels of BLAS,
/// for factors with much fill. The matrix stands in the order of elimination and in postorder.
/// The factorization is the library's; only the way of the blocks into it and out of it is ours.
/// That part of CHOLMOD is under the GPL: without it (PLACEGRAPH_GPL=OFF) ScalarFactor takes its
/// place.
class SupernodalFactor {
 public:
  /// `matrix` must outlive the factor and keep its pattern; its values may change.
  explicit SupernodalFactor(const BlockPanels& matrix);
  ~SupernodalFactor();

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
