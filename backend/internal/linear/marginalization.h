#pragma once
#include <Eigen/Core>

namespace placegraph {

/// The quadratic 1/2 x^T H x + b^T x: normal equations of a linearized least-squares problem.
struct QuadraticForm {
  Eigen::MatrixXd H;
  Eigen::VectorXd b;
};

/// Marginalizes the first `count` variables: what is left of the form when they take their best
/// values, H = H_rr - H_rm H_mm^-1 H_mr, b = b_r - H_rm H_mm^-1 b_m. Directions of the first
/// variables that carry no information (eigenvalue of the diagonally scaled H_mm below a floor of
/// rounding size) are left out of the inverse; H comes back symmetric. `reference_diagonal`, if
/// given, says how large the first diagonal entries of H were before cancellation: what is left of
/// them below 1e-10 of that is rounding, not information.
QuadraticForm marginalize_first(const QuadraticForm& form, Eigen::Index count,
                                const Eigen::VectorXd* reference_diagonal = nullptr);

/// H = J^T J and b = J^T e, from the eigenvectors of the diagonally scaled H; directions below the
/// floor, and negative ones that rounding makes, are left out: J has as many rows as H has rank.
struct SquareRootForm {
  Eigen::MatrixXd J;
  Eigen::VectorXd e;
};
SquareRootForm square_root(const QuadraticForm& form);

/// H made positive semi-definite: eigenvalues of the diagonally scaled matrix below `floor` of the
/// largest become zero.
Eigen::MatrixXd clamp_to_semidefinite(const Eigen::MatrixXd& H, double floor);

}  // namespace placegraph
