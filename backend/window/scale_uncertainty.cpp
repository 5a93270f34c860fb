#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/backend/window/window_state.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace placegraph {

double sigma_log_length_ratio(const SlidingWindow& window, std::int64_t first, std::int64_t middle,
                              std::int64_t last) {
  const WindowState& state = window.state();
  for (const std::int64_t id : {first, middle, last})
    require_variable(state, keyframe_variable(id));
  require(first != middle && middle != last && first != last,
          "sliding window: a ratio of lengths needs three keyframes");
  const SE3 &T_a = state.keyframes.at(first), &T_b = state.keyframes.at(middle),
            &T_c = state.keyframes.at(last);
  const Eigen::Vector3d ab = T_b.translation() - T_a.translation();
  const Eigen::Vector3d bc = T_c.translation() - T_b.translation();
  if (!(ab.squaredNorm() > 0) || !(bc.squaredNorm() > 0))
    return std::numeric_limits<double>::infinity();
  // d log|x| = x^T dx / |x|^2, and a keyframe moves by R times the translation of its tangent.
  const Eigen::RowVector3d d_ab = ab.transpose() / ab.squaredNorm();
  const Eigen::RowVector3d d_bc = bc.transpose() / bc.squaredNorm();
  Eigen::RowVectorXd J = Eigen::RowVectorXd::Zero(18);
  J.segment<3>(0) = d_ab * T_a.rotation().matrix();
  J.segment<3>(6) = -(d_ab + d_bc) * T_b.rotation().matrix();
  J.segment<3>(12) = d_bc * T_c.rotation().matrix();

  // The ratio does not feel the gauge, whose directions the information leaves open: they are left
  // out of the inverse. Scaled to a unit diagonal, as metres and radians have no common size.
  const Eigen::MatrixXd H = joint_information(
      state, window.information(),
      {keyframe_variable(first), keyframe_variable(middle), keyframe_variable(last)});
  const Eigen::VectorXd scale = H.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * H *
                                                             scale.asDiagonal());
  const Eigen::VectorXd share =
      eigen.eigenvectors().transpose() * (J * scale.asDiagonal()).transpose();
  constexpr double kOpen = 1e-10;
  double variance = 0;
  for (Eigen::Index k = 0; k < share.size(); ++k)
    if (eigen.eigenvalues()[k] > kOpen) variance += share[k] * share[k] / eigen.eigenvalues()[k];
  return std::sqrt(variance);
}

}  // namespace placegraph
