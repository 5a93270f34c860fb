#include <placegraph/graph/geometry/rotation_series.h>
#include <placegraph/graph/geometry/se3.h>

namespace placegraph {
namespace {

/// The upper right block of the left Jacobian (Barfoot 2017, eq. 7.86).
Eigen::Matrix3d left_jacobian_block(const Eigen::Vector3d& rho, const Eigen::Vector3d& w) {
  const internal::RotationSeries series(w.squaredNorm());
  const Eigen::Matrix3d P = hat(rho), W = hat(w);
  const Eigen::Matrix3d WP = W * P, PW = P * W, WPW = WP * W;
  return 0.5 * P + series.s3 * (WP + PW + WPW) + series.s4 * (W * WP + PW * W - 3 * WPW) +
         0.5 * (series.s4 - 3 * series.s5) * (WPW * W + W * WPW);
}

}  // namespace

SE3 SE3::exp(const Tangent& xi) {
  const Eigen::Vector3d rho = xi.head<3>(), w = xi.tail<3>();
  const internal::RotationSeries series(w.squaredNorm());
  const Eigen::Vector3d w_rho = w.cross(rho);
  return SE3(SO3::exp(w), rho + series.s2 * w_rho + series.s3 * w.cross(w_rho));
}

SE3::Tangent SE3::log() const {
  const Eigen::Vector3d w = R_.log();
  const double x = w.squaredNorm();
  const double coefficient = internal::inverse_jacobian_coefficient(internal::RotationSeries(x), x);
  const Eigen::Vector3d w_t = w.cross(t_);
  Tangent xi;
  xi << t_ - 0.5 * w_t + coefficient * w.cross(w_t), w;
  return xi;
}

Eigen::Matrix4d SE3::matrix() const {
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  T.topLeftCorner<3, 3>() = R_.matrix();
  T.topRightCorner<3, 1>() = t_;
  return T;
}

Eigen::Isometry3d SE3::isometry() const { return Eigen::Isometry3d(matrix()); }

SE3::Jacobian SE3::adjoint() const {
  const Eigen::Matrix3d R = R_.matrix();
  Jacobian A;
  A << R, hat(t_) * R, Eigen::Matrix3d::Zero(), R;
  return A;
}

SE3::Jacobian SE3::ad(const Tangent& xi) {
  const Eigen::Matrix3d W = hat(xi.tail<3>());
  Jacobian A;
  A << W, hat(xi.head<3>()), Eigen::Matrix3d::Zero(), W;
  return A;
}

SE3::Jacobian SE3::right_jacobian(const Tangent& xi) {
  const Eigen::Matrix3d D = SO3::right_jacobian(xi.tail<3>());
  Jacobian J;
  J << D, left_jacobian_block(-xi.head<3>(), -xi.tail<3>()), Eigen::Matrix3d::Zero(), D;
  return J;
}

SE3::Jacobian SE3::right_jacobian_inverse(const Tangent& xi) {
  const Eigen::Matrix3d D = SO3::right_jacobian_inverse(xi.tail<3>());
  Jacobian J;
  J << D, -D * left_jacobian_block(-xi.head<3>(), -xi.tail<3>()) * D, Eigen::Matrix3d::Zero(), D;
  return J;
}

}  // namespace placegraph
