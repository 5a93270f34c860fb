#pragma once
#include <placegraph/backend/initialization/isotropic_problem.h>
#include <placegraph/backend/linear/block_cholesky.h>

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

namespace placegraph {

/// The isotropic chordal problem lifted to r >= d dimensions, and its manifold.
/// Rosen et al. 2019, problem 9; here with the translations kept: over X = [Y_1 p_1 ... Y_n p_n], r
/// x (d+1)n, Y_i of the Stiefel manifold St(d, r), p_i of R^r
///
///   f(X) = tr(X Q X^T) = sum rotation_weight |Y_j - Y_i R_ij|_F^2
///                            + translation_weight |p_j - p_i - Y_i t_ij|^2
///
/// One object is valid for every rank r, the number of rows of X. Tangent vectors V have the form
/// of X.
template <int dim>
class LiftedProblem {
 public:
  static constexpr int kBlock = dim + 1;  ///< columns of a node
  using Multipliers = std::vector<Eigen::Matrix<double, dim, dim>>;

  explicit LiftedProblem(const IsotropicProblem<dim>& isotropic);

  const IsotropicProblem<dim>& isotropic() const { return isotropic_; }
  /// Ordering of the nodes, for any matrix with the pattern of Q.
  const BlockOrdering& ordering() const { return ordering_; }
  int nodes() const { return isotropic_.nodes; }

  static auto Y(Eigen::MatrixXd& X, int i) { return X.middleCols<dim>(i * kBlock); }
  static auto Y(const Eigen::MatrixXd& X, int i) { return X.middleCols<dim>(i * kBlock); }
  static auto p(Eigen::MatrixXd& X, int i) { return X.col(i * kBlock + dim); }
  static auto p(const Eigen::MatrixXd& X, int i) { return X.col(i * kBlock + dim); }

  /// f(X)
  double cost(const Eigen::MatrixXd& X) const;
  /// X Q, half the gradient of f in the space around the manifold.
  Eigen::MatrixXd product(const Eigen::MatrixXd& X) const;
  /// Lambda_i = sym(Y_i^T (XQ)_i)
  Multipliers multipliers(const Eigen::MatrixXd& X, const Eigen::MatrixXd& XQ) const;
  /// proj(V Q - V Lambda), half the Hessian of f at X along V.
  Eigen::MatrixXd hessian(const Eigen::MatrixXd& X, const Multipliers& lambda,
                          const Eigen::MatrixXd& V) const;

  /// Projects V on the tangent space at X: V_i - Y_i sym(Y_i^T V_i).
  void project(const Eigen::MatrixXd& X, Eigen::MatrixXd& V) const;
  /// The retraction of V at X, by the polar factor of Y_i + V_i. The translations follow the
  /// rotations, so that they do not resist a bend of a long chain.
  Eigen::MatrixXd retract(const Eigen::MatrixXd& X, const Eigen::MatrixXd& V) const;
  /// Replaces the translations by the optimal ones for the rotations, with the first of every
  /// component at the origin; they are unchanged if the measurements do not determine them.
  void solve_translations(Eigen::MatrixXd& X) const;

 private:
  void factorize_translations();

  IsotropicProblem<dim> isotropic_;
  std::vector<std::pair<int, int>> pairs_;  // pairs of nodes with off-diagonal blocks
  BlockOrdering ordering_;
  std::optional<BlockCholesky> laplacian_;  // Laplacian of the translations, factorized
};

}  // namespace placegraph
