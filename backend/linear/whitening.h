#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace placegraph {

/// W with W^T W = information, for information of any rank.
/// Rows of directions without information are zero. `deficient`, if given, is set if the rank is
/// not full.
template <class Matrix>
Matrix whitening(const Matrix& information, bool* deficient = nullptr) {
  const Eigen::LLT<Matrix> llt(information);
  if (llt.info() == Eigen::Success) {
    const auto pivots = llt.matrixLLT().diagonal();
    if (deficient) *deficient |= pivots.minCoeff() < 1e-6 * pivots.maxCoeff();
    return llt.matrixU();
  }
  if (deficient) *deficient = true;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(information);
  return eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
         eigen.eigenvectors().transpose();
}

}  // namespace placegraph
