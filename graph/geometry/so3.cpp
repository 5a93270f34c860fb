#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/rotation_series.h>
#include <placegraph/graph/geometry/so3.h>

#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <string>

namespace placegraph {

SO3::SO3(const Eigen::Quaterniond& q) : q_(q) {
  const double squared_norm = q.squaredNorm();
  require(squared_norm > 0 && std::isfinite(squared_norm),
          "rotation: the quaternion is zero or not finite");
  // A quaternion of unit length within rounding is stored unchanged, so that files reproduce it.
  constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();
  if (std::abs(squared_norm - 1) > kRounding) q_.coeffs() /= std::sqrt(squared_norm);
}

SO3 SO3::from_matrix(const Eigen::Matrix3d& R) {
  require(R.allFinite(), "rotation: the matrix is not finite");
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  // The singular values of R^T R - I are |s^2 - 1|.
  const double deviation = (svd.singularValues().array().square() - 1).abs().maxCoeff();
  const Eigen::Matrix3d nearest = svd.matrixU() * svd.matrixV().transpose();
  require(nearest.determinant() > 0, "rotation: the matrix mirrors");
  require(deviation <= 1e-2,
          "rotation: the matrix is " + std::to_string(deviation) + " away from orthonormal");
  return SO3(Eigen::Quaterniond(nearest));
}

SO3 SO3::exp(const Tangent& w) {
  const double angle = w.norm();
  const double factor = angle > 0 ? std::sin(angle / 2) / angle : 0.5;
  Eigen::Quaterniond q;
  q.w() = std::cos(angle / 2);
  q.vec() = factor * w;
  return SO3(q, Unit{});
}

SO3::Tangent SO3::log() const {
  // q and -q are the same rotation; the one with w >= 0 has the angle within [0, pi].
  const double sign = q_.w() < 0 ? -1 : 1;
  const double sine = q_.vec().norm(), cosine = sign * q_.w();
  const double factor = sine > 0 ? 2 * std::atan2(sine, cosine) / sine : 2;
  return sign * factor * q_.vec();
}

SO3::Jacobian SO3::right_jacobian(const Tangent& w) {
  const internal::RotationSeries series(w.squaredNorm());
  const Eigen::Matrix3d W = hat(w);
  return Eigen::Matrix3d::Identity() - series.s2 * W + series.s3 * W * W;
}

SO3::Jacobian SO3::right_jacobian_inverse(const Tangent& w) {
  const double x = w.squaredNorm();
  const Eigen::Matrix3d W = hat(w);
  return Eigen::Matrix3d::Identity() + 0.5 * W +
         internal::inverse_jacobian_coefficient(internal::RotationSeries(x), x) * W * W;
}

}  // namespace placegraph
