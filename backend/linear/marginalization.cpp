#include <placegraph/backend/linear/marginalization.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

/// Eigenvalues of the scaled matrix below this share of the largest are rounding.
constexpr double kFloor = 1e-12;
/// Rounding of differences of sums, as a share of a diagonal entry.
constexpr double kCancellation = 1e-10;

/// H = D V diag(lambda) V^T D with D^2 = diag(H): translations in metres and rotations in radians
/// differ by orders of magnitude, so eigenvalues are comparable only after scaling.
struct ScaledEigen {
  explicit ScaledEigen(const Eigen::MatrixXd& H, double floor_share = kFloor,
                       const Eigen::VectorXd* reference_diagonal = nullptr)
      : scale(H.rows()) {
    for (Eigen::Index i = 0; i < H.rows(); ++i) {
      const double reference = reference_diagonal ? (*reference_diagonal)[i] : 0.0;
      const double size = H(i, i) > kCancellation * reference ? H(i, i) : reference;
      scale[i] = size > std::numeric_limits<double>::min() ? std::sqrt(size) : 1.0;
    }
    if (reference_diagonal) floor_share = kCancellation;
    const Eigen::VectorXd inverse = scale.cwiseInverse();
    const Eigen::MatrixXd scaled = inverse.asDiagonal() * H * inverse.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (scaled + scaled.transpose()));
    lambda = eigen.eigenvalues();
    V = eigen.eigenvectors();
    const double floor =
        lambda.size() ? floor_share * lambda.size() * std::max(1.0, lambda.tail<1>()[0]) : 0.0;
    first = 0;
    while (first < lambda.size() && !(lambda[first] > floor)) ++first;
  }
  Eigen::Index rank() const { return lambda.size() - first; }

  Eigen::VectorXd scale, lambda;
  Eigen::MatrixXd V;
  Eigen::Index first;  ///< eigenvalues from here on carry information (ascending)
};

}  // namespace

QuadraticForm marginalize_first(const QuadraticForm& form, Eigen::Index count,
                                const Eigen::VectorXd* reference_diagonal) {
  const Eigen::Index rest = form.H.rows() - count;
  if (count == 0) return form;
  const ScaledEigen eigen(form.H.topLeftCorner(count, count), kFloor, reference_diagonal);
  // B = lambda^-1/2 V^T D^-1, so that the pseudo-inverse of H_mm is B^T B.
  const Eigen::MatrixXd B =
      eigen.lambda.tail(eigen.rank()).cwiseSqrt().cwiseInverse().asDiagonal() *
      eigen.V.rightCols(eigen.rank()).transpose() * eigen.scale.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd G = B * form.H.topRightCorner(count, rest);
  QuadraticForm marginal;
  marginal.H = form.H.bottomRightCorner(rest, rest);
  marginal.H.noalias() -= G.transpose() * G;
  marginal.H = 0.5 * (marginal.H + marginal.H.transpose()).eval();
  marginal.b = form.b.tail(rest) - G.transpose() * (B * form.b.head(count));
  return marginal;
}

SquareRootForm square_root(const QuadraticForm& form) {
  const ScaledEigen eigen(form.H);
  const Eigen::VectorXd root = eigen.lambda.tail(eigen.rank()).cwiseSqrt();
  const auto V = eigen.V.rightCols(eigen.rank());
  SquareRootForm result;
  result.J = root.asDiagonal() * V.transpose() * eigen.scale.asDiagonal();
  result.e = root.cwiseInverse().asDiagonal() * V.transpose() *
             eigen.scale.cwiseInverse().asDiagonal() * form.b;
  return result;
}

Eigen::MatrixXd clamp_to_semidefinite(const Eigen::MatrixXd& H, double floor) {
  const ScaledEigen eigen(H, floor);
  const Eigen::MatrixXd J = eigen.lambda.tail(eigen.rank()).cwiseSqrt().asDiagonal() *
                            eigen.V.rightCols(eigen.rank()).transpose() * eigen.scale.asDiagonal();
  return J.transpose() * J;
}

}  // namespace placegraph
