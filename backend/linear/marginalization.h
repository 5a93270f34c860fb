#pragma once
#include <Eigen/Core>

namespace placegraph {

/// The quadratic 1/2 x^T H x + b^T x: normal equations of a linearized least-squares problem.
struct QuadraticForm {
  Eigen::MatrixXd H;
  Eigen::VectorXd b;
};

/// Marginalizes the first `count` variables of a form.
/// The result is the form minimized over them: H = H_rr - H_rm H_mm^-1 H_mr, b = b_r - H_rm H_mm^-1
/// b_m. Directions of the first variables that carry no information (eigenvalue of the diagonally
/// scaled H_mm below a floor of rounding size) are left out of the inverse; the result is
/// symmetric. `reference_diagonal`, if given, has the first diagonal entries of H before
/// cancellation: remainders below 1e-10 of these are rounding, not information.
QuadraticForm marginalize_first(const QuadraticForm& form, Eigen::Index count,
                                const Eigen::VectorXd* reference_diagonal = nullptr);

/// A square root of a form: H = J^T J and b = J^T e.
/// From the eigenvectors of the diagonally scaled H; directions below the floor, and negative ones
/// caused by rounding, are left out: the number of rows of J is the rank of H.
struct SquareRootForm {
  Eigen::MatrixXd J;
  Eigen::VectorXd e;
};
SquareRootForm square_root(const QuadraticForm& form);

/// Projects H on positive semi-definite matrices.
/// Eigenvalues of the diagonally scaled matrix below `floor` times the largest are set to zero.
Eigen::MatrixXd clamp_to_semidefinite(const Eigen::MatrixXd& H, double floor);

}  // namespace placegraph
