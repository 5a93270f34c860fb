#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/sim3.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

namespace placegraph {
namespace {

constexpr int kMoments = 13;

/// Integrals of tau^k exp(sigma tau) over [0, 1], k = 0 .. 12.
std::array<double, kMoments> exponential_moments(double sigma) {
  std::array<double, kMoments> moments;
  if (std::abs(sigma) < 2) {
    for (int k = 0; k < kMoments; ++k) {
      double power = 1, sum = 0;  // sum_j sigma^j / (j! (j + k + 1))
      for (int j = 0; j < 30; power *= sigma / ++j) sum += power / (j + k + 1);
      moments[k] = sum;
    }
  } else {
    moments[0] = std::expm1(sigma) / sigma;
    for (int k = 1; k < kMoments; ++k) moments[k] = (std::exp(sigma) - k * moments[k - 1]) / sigma;
  }
  return moments;
}

/// V = integral of exp(sigma tau) exp(tau hat(w)) over [0, 1] = a I + b hat(w) + c hat(w)^2: exp
/// maps the translation part of the tangent by it. Small sigma and small angle, alone or together,
/// keep full precision: power series in the angle where the closed form would cancel.
Eigen::Matrix3d translation_matrix(const Eigen::Vector3d& w, double sigma) {
  const double angle = w.norm(), x = angle * angle;
  const double a = sigma != 0 ? std::expm1(sigma) / sigma : 1;
  double b = 0, c = 0;
  if (angle < 0.3) {
    const auto moments = exponential_moments(sigma);
    double factor = 1;  // (-x)^n / (2n + 1)!
    for (int n = 0; n <= 5; ++n) {
      b += factor * moments[2 * n + 1];
      c += factor * moments[2 * n + 2] / (2 * n + 2);
      factor *= -x / ((2 * n + 2) * (2 * n + 3));
    }
  } else {
    const std::complex<double> z(sigma, angle);
    const std::complex<double> phi = (std::exp(z) - 1.0) / z;
    b = phi.imag() / angle;
    c = (a - phi.real()) / x;
  }
  const Eigen::Matrix3d W = hat(w);
  return a * Eigen::Matrix3d::Identity() + b * W + c * W * W;
}

/// phi_1(A) = sum A^n / (n + 1)!: the Taylor series of A / 2^k, then k times
/// phi_1(2 A) = (exp(A) + I) phi_1(A) / 2 (Al-Mohy & Higham 2011). Of what is not finite no number.
Matrix7d phi1(Matrix7d A) {
  double norm = A.cwiseAbs().rowwise().sum().maxCoeff();
  if (!std::isfinite(norm)) return Matrix7d::Constant(std::numeric_limits<double>::quiet_NaN());
  int doublings = 0;
  for (; norm > 0.5; norm /= 2) ++doublings;
  A *= std::ldexp(1, -doublings);
  const Matrix7d I = Matrix7d::Identity();
  Matrix7d phi = I;
  for (int n = 14; n >= 1; --n) phi = I + A * phi / (n + 1);  // 0.5^15 / 16! < 1e-17
  for (; doublings > 0; --doublings, A *= 2) phi = (I + 0.5 * A * phi) * phi;
  return phi;
}

}  // namespace

Sim3::Sim3(const SO3& rotation, const Eigen::Vector3d& translation, double scale)
    : R_(rotation), t_(translation), s_(scale) {
  if (!(scale > 0 && std::isfinite(scale)))
    throw ArgumentError("similarity: scale " + std::to_string(scale) + " is not positive");
}

Sim3 Sim3::exp(const Tangent& xi) {
  const Eigen::Vector3d w = xi.segment<3>(3);
  return Sim3(SO3::exp(w), translation_matrix(w, xi[6]) * xi.head<3>(), std::exp(xi[6]));
}

Sim3::Tangent Sim3::log() const {
  const Eigen::Vector3d w = R_.log();
  const double sigma = std::log(s_);
  Tangent xi;
  xi << translation_matrix(w, sigma).partialPivLu().solve(t_), w, sigma;
  return xi;
}

Sim3 Sim3::inverse() const {
  const SO3 R_inverse = R_.inverse();
  return Sim3(R_inverse, -(R_inverse * t_) / s_, 1 / s_);
}

Sim3 Sim3::operator*(const Sim3& other) const {
  return Sim3(R_ * other.R_, t_ + s_ * (R_ * other.t_), s_ * other.s_);
}

Eigen::Matrix4d Sim3::matrix() const {
  Eigen::Matrix4d S = Eigen::Matrix4d::Identity();
  S.topLeftCorner<3, 3>() = s_ * R_.matrix();
  S.topRightCorner<3, 1>() = t_;
  return S;
}

Sim3::Jacobian Sim3::adjoint() const {
  const Eigen::Matrix3d R = R_.matrix();
  Jacobian A = Jacobian::Identity();
  A.topLeftCorner<3, 3>() = s_ * R;
  A.block<3, 3>(0, 3) = hat(t_) * R;
  A.block<3, 1>(0, 6) = -t_;
  A.block<3, 3>(3, 3) = R;
  return A;
}

Sim3::Jacobian Sim3::ad(const Tangent& xi) {
  const Eigen::Matrix3d W = hat(xi.segment<3>(3));
  Jacobian A = Jacobian::Zero();
  A.topLeftCorner<3, 3>() = W + xi[6] * Eigen::Matrix3d::Identity();
  A.block<3, 3>(0, 3) = hat(xi.head<3>());
  A.block<3, 1>(0, 6) = -xi.head<3>();
  A.block<3, 3>(3, 3) = W;
  return A;
}

Sim3::Jacobian Sim3::right_jacobian(const Tangent& xi) {
  // Scaling reduces a long translation to at most 1, so that it does not increase the number of
  // doublings. The factor is a power of two and costs no precision.
  const double length = xi.head<3>().stableNorm();
  const double unit = length > 1 ? std::ldexp(1, std::ilogb(length) + 1) : 1;
  Tangent scaled = xi;
  scaled.head<3>() /= unit;
  Jacobian J = phi1(-ad(scaled));
  J.topRightCorner<3, 4>() *= unit;
  return J;
}

Sim3::Jacobian Sim3::right_jacobian_inverse(const Tangent& xi) {
  const Jacobian J = right_jacobian(xi);
  const Eigen::Matrix3d A = J.topLeftCorner<3, 3>().inverse();
  const Eigen::Matrix3d D = SO3::right_jacobian_inverse(xi.segment<3>(3));
  Jacobian inverse = Jacobian::Identity();
  inverse.topLeftCorner<3, 3>() = A;
  inverse.block<3, 3>(0, 3) = -A * J.block<3, 3>(0, 3) * D;
  inverse.block<3, 1>(0, 6) = -A * J.block<3, 1>(0, 6);
  inverse.block<3, 3>(3, 3) = D;
  return inverse;
}

}  // namespace placegraph
