#pragma once
#include <placegraph/backend/internal/initialization/isotropic_problem.h>
#include <placegraph/backend/internal/linear/block_cholesky.h>

#include <string>

namespace placegraph {

/// The certificate matrix S = Q - Lambda(X) of the isotropic chordal problem at a point X of any
/// rank (Rosen et al. 2019, theorem 7; Lambda_i = sym(Y_i^T (XQ)_i) on the rotations, zero on the
/// translations). With S + shift on the rotations positive semi-definite, every feasible point has
///
///   f = tr(X S X^T) + sum tr(Lambda_i) >= sum tr(Lambda_i) - n d shift
///
/// because tr(Y_i^T Y_i) = d. That holds for any Lambda, so also where X is not quite critical.
template <int dim>
class CertificateMatrix {
 public:
  using Multipliers = std::vector<Eigen::Matrix<double, dim, dim>>;
  CertificateMatrix(const IsotropicProblem<dim>& problem, const BlockOrdering& ordering,
                    const Multipliers& multipliers);

  struct Curvature {
    double smallest_eigenvalue = 0;  ///< of S on the rotations, translations eliminated
    double shift = 0;                ///< with which S was factorized: a proven bound
    /// (d+1)n, v^T S v = smallest_eigenvalue |v on the rotations|^2; empty if it was not searched.
    Eigen::VectorXd direction;
    int factorizations = 0, solutions = 0;  ///< what it took
  };
  /// If S + `accepted_shift` can be factorized at once, nothing more is computed, and the
  /// eigenvalue is said to be that bound; else a shift-and-invert Lanczos search (Spectra), which
  /// an accepted shift of zero always starts; after `max_restarts` it is given up, and the
  /// eigenvalue is said to be the bound that was proven on the way. A matrix that is not finite has
  /// the shift infinity: nothing is proven.
  Curvature curvature(double accepted_shift, int max_restarts = 300);
  /// Whether S + shift is positive definite, by a factorization: nothing is searched.
  [[nodiscard]] bool positive_with(double shift) { return factorize(shift); }
  /// sum tr(Lambda_i) - n d shift
  double lower_bound(double shift) const;
  /// (cost - lower_bound) / cost; a cost of nothing but rounding (residuals below 3e-5 rad) is
  /// lifted to that level first.
  double relative_gap(double cost, double lower_bound) const;
  /// Mean diagonal entry of Q on the rotations: what eigenvalues are to be compared with.
  double scale() const { return scale_; }

 private:
  bool factorize(double shift);

  const IsotropicProblem<dim>& problem_;
  BlockCholesky matrix_;
  double dual_value_ = 0, scale_ = 0, pin_ = 0;
};

}  // namespace placegraph
