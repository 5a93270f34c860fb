#pragma once
#include <placegraph/backend/linear/block_columns.h>

#include <Eigen/Core>
#include <memory>

namespace placegraph {

/// Cholesky factor of a block-sparse matrix that is in the order of elimination, by a method that
/// supports every block size. SimplicialFactor is faster where there is little fill.
class FillFactor {
 public:
  virtual ~FillFactor() = default;

  /// False if the matrix is not positive definite.
  [[nodiscard]] virtual bool factorize() = 0;
  /// Solves in place, column by column, in the order of the matrix.
  virtual void solve(Eigen::Ref<Eigen::MatrixXd> x) = 0;
  virtual Eigen::VectorXd pivots() const = 0;  ///< diagonal of L
  virtual BlockFactor blocks() const = 0;
};

// `matrix` must outlive the factor and keep its pattern; its values may change.

/// By CHOLMOD's supernodal method, whose dense kernels are those of BLAS. `matrix` must be in
/// postorder. That part of CHOLMOD is under the GPL: PLACEGRAPH_GPL=OFF leaves it out.
std::unique_ptr<FillFactor> supernodal_factor(const BlockPanels& matrix);
/// By scalars, with Eigen's simplicial method: slower, without the GPL parts of CHOLMOD.
std::unique_ptr<FillFactor> scalar_factor(const BlockPanels& matrix);

}  // namespace placegraph
