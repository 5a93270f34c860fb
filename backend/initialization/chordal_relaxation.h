#pragma once
#include <placegraph/backend/initialization/certificate_matrix.h>
#include <placegraph/backend/initialization/descent_effort.h>
#include <placegraph/backend/initialization/lifted_problem.h>

#include <Eigen/Core>
#include <limits>

namespace placegraph {

/// The semidefinite relaxation of the isotropic chordal problem.
/// It is solved in its lifted forms of low rank (LiftedProblem; Rosen et al. 2019), whose cost is
/// f.
///
/// For r = d it is the problem itself (with reflections allowed). A first-order critical point of
/// any r at which S = Q - Lambda(X) is positive semi-definite is a global minimum over all r, and
/// f there a lower bound of the problem.
template <int dim>
class ChordalRelaxation {
 public:
  explicit ChordalRelaxation(const IsotropicProblem<dim>& problem);

  /// The lifted point of rank d.
  template <class Group>
  Eigen::MatrixXd point(const std::vector<Group>& poses) const;

  double cost(const Eigen::MatrixXd& X) const;

  struct DescentOptions {
    int max_steps = 300;
    /// Stop when the preconditioned gradient predicts a decrease below this share of the cost.
    double promise_share = 1e-14;
    /// No step starts after this effort; in iterations, see Descent.
    double max_effort = std::numeric_limits<double>::infinity();
  };
  struct Descent {
    double cost = 0;
    int iterations = 0, products = 0;  ///< outer steps; Hessian products within them
    double effort = 0;                 ///< see DescentEffort
    bool converged = false;
  };
  /// Descends to a critical point near X.
  /// By a Riemannian trust-region method with truncated conjugate gradients (Absil et al. 2007),
  /// preconditioned with the Gauss-Newton Hessian's Cholesky factor.
  Descent minimize(Eigen::MatrixXd& X, const DescentOptions& options) const;
  Descent minimize(Eigen::MatrixXd& X) const { return minimize(X, DescentOptions{}); }

  /// Effort of these numbers of factorizations of S and solutions with it; see DescentEffort.
  double certificate_effort(int factorizations, int solutions) const;

  /// S at X.
  CertificateMatrix<dim> certificate_matrix(const Eigen::MatrixXd& X) const;

  /// X with one more row, after a step along a direction of negative curvature that lowers the
  /// cost.
  Eigen::MatrixXd escape(const Eigen::MatrixXd& X, const Eigen::VectorXd& direction) const;

  /// The point of rank d nearest to X.
  /// The rows are projected on the d leading singular vectors, and the rotations are made proper;
  /// the translations follow.
  Eigen::MatrixXd round(const Eigen::MatrixXd& X) const;

 private:
  using Lifted = LiftedProblem<dim>;

  Lifted problem_;
  DescentEffort effort_;
};

}  // namespace placegraph
