#pragma once
#include <placegraph/backend/initialization/certificate_matrix.h>
#include <placegraph/backend/initialization/isotropic_problem.h>

#include <Eigen/Core>
#include <limits>
#include <memory>

namespace placegraph {

/// The isotropic chordal problem lifted to r >= d dimensions (Rosen et al. 2019, problem 9; here
/// with the translations kept): over X = [Y_1 p_1 ... Y_n p_n], r x (d+1)n, Y_i of the Stiefel
/// manifold St(d, r), p_i of R^r
///
///   f(X) = tr(X Q X^T) = sum rotation_weight |Y_j - Y_i R_ij|_F^2
///                            + translation_weight |p_j - p_i - Y_i t_ij|^2
///
/// At r = d it is the problem itself (with reflections admitted). A first-order critical point of
/// any r at which S = Q - Lambda(X) is positive semi-definite is a global minimum over all r, and
/// f there a lower bound of the problem.
template <int dim>
class ChordalRelaxation {
 public:
  explicit ChordalRelaxation(const IsotropicProblem<dim>& problem);
  ~ChordalRelaxation();

  /// The lifted point of rank d.
  template <class Group>
  Eigen::MatrixXd point(const std::vector<Group>& poses) const;

  double cost(const Eigen::MatrixXd& X) const;

  struct DescentOptions {
    int max_steps = 300;
    /// The end: the preconditioned gradient promises less than this share of the cost.
    double promise_share = 1e-14;
    /// No step is begun after that; in iterations, see Descent.
    double max_effort = std::numeric_limits<double>::infinity();
  };
  struct Descent {
    double cost = 0;
    int iterations = 0, products = 0;  ///< outer steps; Hessian products inside them
    /// Operations as a multiple of those of one Gauss-Newton iteration on the pose graph itself.
    double effort = 0;
    bool converged = false;
  };
  /// Down to a critical point near X, by a Riemannian trust-region method with truncated conjugate
  /// gradients (Absil et al. 2007), preconditioned with the Gauss-Newton Hessian's Cholesky factor.
  Descent minimize(Eigen::MatrixXd& X, const DescentOptions& options) const;
  Descent minimize(Eigen::MatrixXd& X) const { return minimize(X, DescentOptions{}); }

  /// Of so many factorizations of S and solutions with it; see Descent.
  double certificate_effort(int factorizations, int solutions) const;

  /// S at X.
  CertificateMatrix<dim> certificate_matrix(const Eigen::MatrixXd& X) const;

  /// X with one row more, lowered along a direction of negative curvature.
  Eigen::MatrixXd escape(const Eigen::MatrixXd& X, const Eigen::VectorXd& direction) const;

  /// The point of rank d nearest to X: rows turned onto the d leading singular vectors, rotations
  /// made proper; translations follow.
  Eigen::MatrixXd round(const Eigen::MatrixXd& X) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace placegraph
