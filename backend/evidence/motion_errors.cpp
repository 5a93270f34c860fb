#include <placegraph/backend/evidence/motion_errors.h>
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/backend/window/window_information.h>
#include <placegraph/backend/window/window_state.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace placegraph {
namespace {

/// Derivative of the right tangent of T_from_to by the variables of the window.
Eigen::MatrixXd derivative_of_motion(const SlidingWindow& window, KeyframeId from, KeyframeId to) {
  const WindowState& state = window.state();
  const SE3 T_to_from = state.keyframes.at(to).inverse() * state.keyframes.at(from);
  const WindowInformation& information = window.information();
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(6, information.H.cols());
  Eigen::Index column = 0;
  for (const WindowVariable& variable : information.variables) {
    if (variable == keyframe_variable(from)) J.middleCols<6>(column) = -T_to_from.adjoint();
    if (variable == keyframe_variable(to)) J.middleCols<6>(column).setIdentity();
    column += degrees_of_freedom(variable);
  }
  return J;
}

}  // namespace

MotionErrors motion_errors(const SlidingWindow& window, KeyframeId from, KeyframeId to) {
  for (const KeyframeId id : {from, to}) require_variable(window.state(), keyframe_variable(id));
  require(from != to, "motion errors: a motion needs two keyframes");
  const auto& [covariance, gradient, images] = window.information().without_prior;
  const Eigen::MatrixXd J = derivative_of_motion(window, from, to);
  const Eigen::MatrixXd JC = J * covariance;
  MotionErrors errors;
  errors.stated = JC * J.transpose();
  errors.scatter = JC * images.scatter * JC.transpose();
  errors.by_imaging_errors = JC * images.H_errors;
  return errors;
}

Matrix6d rescaled_by_scatter(const Matrix6d& covariance, const MotionErrors& errors, double least) {
  // What the images leave open is as uncertain as it is.
  constexpr double kShare = 0.01;
  const Eigen::LLT<Matrix6d> factor(errors.stated + kShare * covariance);
  if (factor.info() != Eigen::Success) return covariance;
  const auto L = factor.matrixL();
  const Matrix6d scatter = errors.scatter + kShare * covariance;
  const Matrix6d half = L.solve(scatter);
  const Matrix6d whitened = L.solve(Matrix6d(half.transpose()));
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(0.5 * (whitened + whitened.transpose()));
  const Vector6d factors = eigen.eigenvalues().cwiseMax(least).cwiseSqrt();
  // A stated A^T = scatter with A = L V factors V^T L^-1.
  const Matrix6d A =
      L * Matrix6d(eigen.eigenvectors() * factors.asDiagonal() * eigen.eigenvectors().transpose() *
                   L.solve(Matrix6d(Matrix6d::Identity())));
  const Matrix6d result = A * covariance * A.transpose();
  return 0.5 * (result + result.transpose());
}

NuisanceEvidence imaging_evidence(const SlidingWindow& window) {
  const auto& [covariance, gradient, images] = window.information().without_prior;
  return {images.gradient - images.H_errors.transpose() * (covariance * gradient),
          images.information - images.H_errors.transpose() * covariance * images.H_errors};
}

}  // namespace placegraph
