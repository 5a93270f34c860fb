#include <placegraph/graph/geometry/rotation_series.h>
#include <placegraph/graph/geometry/se2.h>

#include <cmath>

namespace placegraph {
namespace {

// With h = angle / 2: [sin(a) / a, -(1 - cos a) / a; ...] = sin(h) / h * [cos h, -sin h; sin h, cos
// h], which cancels nowhere.
double sinc(double h) { return h != 0 ? std::sin(h) / h : 1; }

Eigen::Matrix2d scaled_rotation(double a, double b) {
  Eigen::Matrix2d M;
  M << a, -b, b, a;
  return M;
}

/// Integral of R(tau * angle) over tau in [0, 1].
Eigen::Matrix2d mean_rotation(double angle) {
  const double h = angle / 2;
  return scaled_rotation(sinc(h) * std::cos(h), sinc(h) * std::sin(h));
}

Eigen::Matrix2d mean_rotation_inverse(double angle) {
  const double h = angle / 2;
  return scaled_rotation(std::cos(h) / sinc(h), -h);
}

/// Last column of the right Jacobian, translation rows (Sola et al. 2018, eq. 163).
Eigen::Vector2d rotation_column(const SE2::Tangent& xi) {
  const internal::RotationSeries series(xi[2] * xi[2]);
  return scaled_rotation(xi[2] * series.s3, series.s2) * xi.head<2>();
}

}  // namespace

SE2 SE2::exp(const Tangent& xi) { return SE2(SO2(xi[2]), mean_rotation(xi[2]) * xi.head<2>()); }

SE2::Tangent SE2::log() const {
  Tangent xi;
  xi[2] = R_.angle();
  xi.head<2>() = mean_rotation_inverse(xi[2]) * t_;
  return xi;
}

SE2 SE2::inverse() const {
  const SO2 R_inverse = R_.inverse();
  return SE2(R_inverse, -(R_inverse * t_));
}

Eigen::Matrix3d SE2::matrix() const {
  Eigen::Matrix3d T = Eigen::Matrix3d::Identity();
  T.topLeftCorner<2, 2>() = R_.matrix();
  T.topRightCorner<2, 1>() = t_;
  return T;
}

SE2::Jacobian SE2::adjoint() const {
  Jacobian A = matrix();
  A(0, 2) = t_[1];
  A(1, 2) = -t_[0];
  return A;
}

SE2::Jacobian SE2::ad(const Tangent& xi) {
  Jacobian A;
  A << 0, -xi[2], xi[1], xi[2], 0, -xi[0], 0, 0, 0;
  return A;
}

SE2::Jacobian SE2::right_jacobian(const Tangent& xi) {
  Jacobian J = Jacobian::Identity();
  J.topLeftCorner<2, 2>() = mean_rotation(-xi[2]);
  J.topRightCorner<2, 1>() = rotation_column(xi);
  return J;
}

SE2::Jacobian SE2::right_jacobian_inverse(const Tangent& xi) {
  Jacobian J = Jacobian::Identity();
  const Eigen::Matrix2d M = mean_rotation_inverse(-xi[2]);
  J.topLeftCorner<2, 2>() = M;
  J.topRightCorner<2, 1>() = -M * rotation_column(xi);
  return J;
}

}  // namespace placegraph
