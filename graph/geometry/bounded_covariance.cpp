#include <placegraph/graph/geometry/bounded_covariance.h>

#include <Eigen/Dense>
#include <algorithm>

namespace placegraph {
namespace {

// Keeps the inverse finite: deviations of 1000 units. Chosen.
constexpr double kLeastInformation = 1e-6;

template <class Matrix>
Matrix bounded_inverse_of(const Matrix& matrix, double floor) {
  const Eigen::LLT<Matrix> factor(matrix);
  if (factor.info() == Eigen::Success && factor.rcond() > 1e-10) {
    const Matrix inverse = factor.solve(Matrix::Identity());
    // The trace is an upper bound of all eigenvalues, so that none of the matrix is below the
    // floor.
    if (inverse.trace() * floor < 1) return 0.5 * (inverse + inverse.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(0.5 * (matrix + matrix.transpose()));
  const double least = std::max(floor, 1e-12 * eigen.eigenvalues().maxCoeff());
  const Matrix result = eigen.eigenvectors() *
                        eigen.eigenvalues().cwiseMax(least).cwiseInverse().asDiagonal() *
                        eigen.eigenvectors().transpose();
  return 0.5 * (result + result.transpose());
}

}  // namespace

Matrix6d bounded_inverse(const Matrix6d& matrix, double floor) {
  return bounded_inverse_of(matrix, floor);
}
Matrix7d bounded_inverse(const Matrix7d& matrix, double floor) {
  return bounded_inverse_of(matrix, floor);
}

Matrix6d bounded_covariance(const Matrix6d& information) {
  return bounded_inverse_of(information, kLeastInformation);
}
Matrix7d bounded_covariance(const Matrix7d& information) {
  return bounded_inverse_of(information, kLeastInformation);
}

}  // namespace placegraph
