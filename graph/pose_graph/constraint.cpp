#include <placegraph/graph/pose_graph/constraint.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace placegraph {
namespace {

constexpr double kTolerance = 1e-9;  ///< tolerance of asymmetry and of eigenvalues below zero

/// The usual, definite matrix costs one small factorization on the stack.
template <int N>
const char* find_fault(const Eigen::Matrix<double, N, N>& information) {
  using Matrix = Eigen::Matrix<double, N, N>;
  if (!information.allFinite()) return "information is not finite";
  const double largest_entry = information.cwiseAbs().maxCoeff();
  if (largest_entry == 0) return "information is all zero";
  if ((information - information.transpose()).cwiseAbs().maxCoeff() > kTolerance * largest_entry)
    return "information is not symmetric";
  if (information.llt().info() == Eigen::Success) return nullptr;
  const Eigen::Matrix<double, N, 1> eigenvalues =
      Eigen::SelfAdjointEigenSolver<Matrix>(information / largest_entry, Eigen::EigenvaluesOnly)
          .eigenvalues();
  if (!(eigenvalues.minCoeff() >= -kTolerance * eigenvalues.cwiseAbs().maxCoeff()))
    return "information is indefinite";
  return nullptr;
}

}  // namespace

int degrees_of_freedom(PoseKind kind) {
  switch (kind) {
    case PoseKind::kSE2:
      return SE2::kDof;
    case PoseKind::kSE3:
      return SE3::kDof;
    case PoseKind::kSim3:
      break;
  }
  return Sim3::kDof;
}

const char* fault_of(const Information& information) {
  if (information.rows() == information.cols()) {
    if (information.rows() == SE2::kDof) return find_fault<SE2::kDof>(information);
    if (information.rows() == SE3::kDof) return find_fault<SE3::kDof>(information);
    if (information.rows() == Sim3::kDof) return find_fault<Sim3::kDof>(information);
  }
  return "information is neither 3x3 nor 6x6 nor 7x7";
}

const char* fault_of(const Eigen::Matrix3d& information) { return find_fault<3>(information); }

}  // namespace placegraph
