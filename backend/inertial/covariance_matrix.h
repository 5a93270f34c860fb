#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace placegraph {

/// Whether a covariance is finite and positive definite.
inline bool positive_definite(const Eigen::MatrixXd& covariance) {
  return covariance.allFinite() && Eigen::LLT<Eigen::MatrixXd>(covariance).info() == Eigen::Success;
}

/// Exactly symmetric inverse of a symmetric matrix, e.g. the information of a covariance.
inline Eigen::MatrixXd symmetric_inverse(const Eigen::MatrixXd& matrix) {
  const Eigen::MatrixXd inverse =
      matrix.ldlt().solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()));
  return 0.5 * (inverse + inverse.transpose());
}

}  // namespace placegraph
