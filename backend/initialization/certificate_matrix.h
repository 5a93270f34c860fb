#pragma once
#include <placegraph/backend/initialization/isotropic_problem.h>
#include <placegraph/backend/linear/block_cholesky.h>

#include <string>

namespace placegraph {

/// The certificate matrix S = Q - Lambda(X) of the isotropic chordal problem.
/// X is a point of any rank (Rosen et al. 2019, theorem 7); Lambda_i = sym(Y_i^T (XQ)_i) on the
/// rotations, zero on the translations. With S + shift on the rotations positive semi-definite,
/// every feasible point has
///
///   f = tr(X S X^T) + sum tr(Lambda_i) >= sum tr(Lambda_i) - n d shift
///
/// because tr(Y_i^T Y_i) = d. This is true for any Lambda, so also if X is only approximately
/// critical.
template <int dim>
class CertificateMatrix {
 public:
  using Multipliers = std::vector<Eigen::Matrix<double, dim, dim>>;
  CertificateMatrix(const IsotropicProblem<dim>& problem, const BlockOrdering& ordering,
                    const Multipliers& multipliers);

  struct Curvature {
    double smallest_eigenvalue = 0;  ///< smallest eigenvalue of S, translations eliminated
    double shift = 0;                ///< shift with which S was factorized: a proven bound
    /// (d+1)n, v^T S v = smallest_eigenvalue |v on the rotations|^2; empty without a search.
    Eigen::VectorXd direction;
    int factorizations = 0, solutions = 0;  ///< numbers of both
  };
  /// If S + `accepted_shift` can be factorized, nothing more is computed, and this bound is
  /// returned as the eigenvalue. Else a shift-and-invert Lanczos search (Spectra), which an
  /// accepted shift of zero always starts. After `max_restarts` the search is aborted, and the
  /// bound proven so far is returned as the eigenvalue. A matrix that is not finite has the shift
  /// infinity: nothing is proven.
  Curvature curvature(double accepted_shift, int max_restarts = 300);
  /// Whether S + shift is positive definite, by a single factorization.
  [[nodiscard]] bool positive_with(double shift) { return factorize(shift); }
  /// sum tr(Lambda_i) - n d shift
  double lower_bound(double shift) const;
  /// (cost - lower_bound) / cost; a cost that is rounding only (residuals below 3e-5 rad) is
  /// replaced by that level first.
  double relative_gap(double cost, double lower_bound) const;
  /// Mean diagonal entry of Q on the rotations, for comparison with eigenvalues.
  double scale() const { return scale_; }

 private:
  bool factorize(double shift);

  const IsotropicProblem<dim>& problem_;
  BlockCholesky matrix_;
  double dual_value_ = 0, scale_ = 0, pin_ = 0;
};

}  // namespace placegraph
