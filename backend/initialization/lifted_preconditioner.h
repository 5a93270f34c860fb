#pragma once
#include <placegraph/backend/initialization/isotropic_problem.h>
#include <placegraph/backend/linear/block_cholesky.h>

namespace placegraph {

/// Inverse of the Gauss-Newton Hessian of the lifted chordal problem (ChordalRelaxation).
/// The Hessian on the tangent space at a point is B^T Q B with B an orthonormal basis of the
/// tangent vectors. At node i, with [Y_i Z_i] an orthogonal frame of R^r, these are V_i = Y_i W +
/// Z_i K, W antisymmetric, and [Y_i Z_i] u for the translation. The first node of every component
/// is held, which fixes the gauge.
template <int dim>
class LiftedPreconditioner {
 public:
  /// Prepares the pattern of the problem; the ordering is valid for any rank.
  LiftedPreconditioner(const IsotropicProblem<dim>& problem, const BlockOrdering& ordering,
                       int rank);

  /// Factorizes at the point X, r x (d+1)n.
  void factorize(const Eigen::MatrixXd& X);
  /// The tangent vector B (B^T Q B)^-1 B^T V at the point of the last factorization.
  Eigen::MatrixXd apply(const Eigen::MatrixXd& V) const;

 private:
  static std::vector<std::pair<int, int>> pairs(const IsotropicProblem<dim>& problem);
  void assemble();

  const IsotropicProblem<dim>& problem_;
  int rank_, angles_;  // coordinates of a node: angles_ for the rotation, rank_ for the translation
  Eigen::MatrixXd basis_;  // r d x angles_: tangent vectors in the node's frame, as columns
  BlockCholesky matrix_;
  std::vector<Eigen::MatrixXd> frames_;  // r x r
};

}  // namespace placegraph
