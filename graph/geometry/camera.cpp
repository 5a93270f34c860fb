#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/camera.h>

#include <cmath>
#include <numbers>
#include <string>

namespace placegraph {
namespace {

constexpr double kConverged = 1e-10;  ///< residual of the inversion, normalized coordinates

/// The polynomial 1 + c1 x + c2 x^2 + c3 x^3 + c4 x^4.
using Quartic = std::array<double, 5>;

/// Whether five Bernstein coefficients describe a polynomial that is positive on its interval:
/// yes if all are positive, no if one at an end is not positive, otherwise both halves are tested.
bool bernstein_positive(const Quartic& b, int depth) {
  if (!(b[0] > 0 && b[4] > 0)) return false;
  if (b[1] > 0 && b[2] > 0 && b[3] > 0) return true;
  if (depth == 0) return false;
  Quartic left = b, right = b;  // de Casteljau at one half
  for (int level = 1; level < 5; ++level) {
    for (int i = 4; i >= level; --i) left[i] = 0.5 * (left[i] + left[i - 1]);
    for (int i = 0; i <= 4 - level; ++i) right[i] = 0.5 * (right[i] + right[i + 1]);
  }
  return bernstein_positive(left, depth - 1) && bernstein_positive(right, depth - 1);
}

bool positive_up_to(const Quartic& c, double x) {
  const double x2 = x * x;
  const double a1 = c[1] * x / 4, a2 = c[2] * x2 / 6, a3 = c[3] * x2 * x / 4, a4 = c[4] * x2 * x2;
  return bernstein_positive({c[0], c[0] + a1, c[0] + 2 * a1 + a2, c[0] + 3 * a1 + 3 * a2 + a3,
                             c[0] + 4 * a1 + 6 * a2 + 4 * a3 + a4},
                            40);
}

/// Whether r (1 + k1 r^2 + k2 r^4 + k3 r^6) grows all the way from 0 to r: its derivative is
/// positive there.
bool radial_is_monotonic(const std::array<double, 5>& k, double r2) {
  return positive_up_to({1, 3 * k[0], 5 * k[1], 7 * k[4], 0}, r2);
}

bool equidistant_is_monotonic(const std::array<double, 5>& k, double angle) {
  return positive_up_to({1, 3 * k[0], 5 * k[1], 7 * k[2], 9 * k[3]}, angle * angle);
}

/// Distorted angle of a viewing angle [rad] and its derivative.
void distort_angle(const std::array<double, 5>& k, double angle, double& distorted,
                   double& derivative) {
  const double y = angle * angle;
  distorted = angle * (1 + y * (k[0] + y * (k[1] + y * (k[2] + y * k[3]))));
  derivative = 1 + y * (3 * k[0] + y * (5 * k[1] + y * (7 * k[2] + y * 9 * k[3])));
}

void distort_radial_tangential(const std::array<double, 5>& k, const Eigen::Vector2d& n,
                               Eigen::Vector2d& d, Eigen::Matrix2d& J_d_n) {
  const double a = n[0], b = n[1], p1 = k[2], p2 = k[3];
  const double r2 = a * a + b * b;
  const double radial = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double slope = 2 * (k[0] + r2 * (2 * k[1] + r2 * 3 * k[4]));  // d radial / d r2 * 2
  d << a * radial + 2 * p1 * a * b + p2 * (r2 + 2 * a * a),
      b * radial + p1 * (r2 + 2 * b * b) + 2 * p2 * a * b;
  const double mixed = slope * a * b + 2 * p1 * a + 2 * p2 * b;
  J_d_n << radial + slope * a * a + 2 * p1 * b + 6 * p2 * a, mixed, mixed,
      radial + slope * b * b + 6 * p1 * b + 2 * p2 * a;
}

void distort_equidistant(const std::array<double, 5>& k, const Eigen::Vector2d& n,
                         Eigen::Vector2d& d, Eigen::Matrix2d& J_d_n) {
  const double r2 = n.squaredNorm(), r = std::sqrt(r2);
  if (r == 0) {
    d = n;
    J_d_n.setIdentity();
    return;
  }
  double distorted, derivative;
  distort_angle(k, std::atan(r), distorted, derivative);
  const double scale = distorted / r;
  d = scale * n;
  // The bracket is of order r^2, its rounding of order 1e-16: divided by r^2, times n n^T,
  // harmless.
  J_d_n = scale * Eigen::Matrix2d::Identity() +
          (derivative / (1 + r2) - scale) * (n / r) * (n / r).transpose();
}

std::optional<Eigen::Vector2d> undistort_radial_tangential(const std::array<double, 5>& k,
                                                           const Eigen::Vector2d& d) {
  Eigen::Vector2d n = radial_is_monotonic(k, d.squaredNorm()) ? d : Eigen::Vector2d::Zero().eval();
  Eigen::Vector2d value;
  Eigen::Matrix2d J;
  distort_radial_tangential(k, n, value, J);
  double residual = (value - d).norm();
  for (int iteration = 0; iteration < 50 && residual > 1e-15; ++iteration) {
    const double det = J.determinant();
    if (!(std::abs(det) > 1e-12)) break;
    const Eigen::Vector2d step = J.inverse() * (d - value);
    bool improved = false;
    for (double length = 1; length > 1e-6 && !improved; length /= 2) {
      const Eigen::Vector2d candidate = n + length * step;
      distort_radial_tangential(k, candidate, value, J);
      const double candidate_residual = (value - d).norm();
      if (!(candidate_residual < residual) || !radial_is_monotonic(k, candidate.squaredNorm()))
        continue;
      n = candidate;
      residual = candidate_residual;
      improved = true;
    }
    if (!improved) break;
  }
  if (!(residual <= kConverged)) return std::nullopt;
  return n;
}

std::optional<Eigen::Vector2d> undistort_equidistant(const std::array<double, 5>& k,
                                                     const Eigen::Vector2d& d) {
  const double target = d.norm();
  if (target == 0) return d;
  constexpr double kRightAngle = std::numbers::pi / 2;
  double angle = 0, value = 0, derivative = 1;
  for (int iteration = 0; iteration < 100 && std::abs(target - value) > 1e-16; ++iteration) {
    const double step = (target - value) / derivative;
    bool improved = false;
    for (double length = 1; length > 1e-9 && !improved; length /= 2) {
      const double candidate = angle + length * step;
      double candidate_value, candidate_derivative;
      distort_angle(k, candidate, candidate_value, candidate_derivative);
      if (candidate < 0 || candidate >= kRightAngle || !equidistant_is_monotonic(k, candidate) ||
          !(std::abs(target - candidate_value) < std::abs(target - value)))
        continue;
      angle = candidate;
      value = candidate_value;
      derivative = candidate_derivative;
      improved = true;
    }
    if (!improved) break;
  }
  if (!(std::abs(target - value) <= kConverged)) return std::nullopt;
  return d * (std::tan(angle) / target);
}

void require_finite(double value, const char* field) {
  if (!std::isfinite(value))
    throw ArgumentError(std::string(field) + ": " + std::to_string(value) + " is not finite");
}

void require_positive(double value, const char* field) {
  require_finite(value, field);
  if (!(value > 0))
    throw ArgumentError(std::string(field) + ": " + std::to_string(value) + " is not positive");
}

}  // namespace

void Camera::check() const {
  require_positive(width, "camera.width");
  require_positive(height, "camera.height");
  require_positive(fx, "camera.fx");
  require_positive(fy, "camera.fy");
  require_finite(cx, "camera.cx");
  require_finite(cy, "camera.cy");
  for (const double coefficient : coefficients) require_finite(coefficient, "camera.coefficients");
}

Eigen::Matrix3d Camera::K() const {
  Eigen::Matrix3d K;
  K << fx, 0, cx, 0, fy, cy, 0, 0, 1;
  return K;
}

std::optional<Eigen::Vector2d> Camera::project(const Eigen::Vector3d& p_cam,
                                               Eigen::Matrix<double, 2, 3>* J_px_cam) const {
  const double z = p_cam[2];
  if (!(z > 0)) return std::nullopt;
  const Eigen::Vector2d n = p_cam.head<2>() / z;
  if (!n.allFinite()) return std::nullopt;
  Eigen::Vector2d d = n;
  Eigen::Matrix2d J_d_n = Eigen::Matrix2d::Identity();
  if (distortion == Distortion::kRadialTangential) {
    if (!radial_is_monotonic(coefficients, n.squaredNorm())) return std::nullopt;
    distort_radial_tangential(coefficients, n, d, J_d_n);
  } else if (distortion == Distortion::kEquidistant) {
    if (!equidistant_is_monotonic(coefficients, std::atan(n.norm()))) return std::nullopt;
    distort_equidistant(coefficients, n, d, J_d_n);
  }
  if (J_px_cam) {
    Eigen::Matrix<double, 2, 3> J_n_cam;
    J_n_cam << 1, 0, -n[0], 0, 1, -n[1];
    *J_px_cam = Eigen::Vector2d(fx, fy).asDiagonal() * J_d_n * (J_n_cam / z);
  }
  return Eigen::Vector2d(fx * d[0] + cx, fy * d[1] + cy);
}

std::optional<Eigen::Vector3d> Camera::unproject(const Eigen::Vector2d& px) const {
  const Eigen::Vector2d d((px[0] - cx) / fx, (px[1] - cy) / fy);
  if (!d.allFinite()) return std::nullopt;
  std::optional<Eigen::Vector2d> n = d;
  if (distortion == Distortion::kRadialTangential) n = undistort_radial_tangential(coefficients, d);
  if (distortion == Distortion::kEquidistant) n = undistort_equidistant(coefficients, d);
  if (!n) return std::nullopt;
  return n->homogeneous();
}

void Calibration::check() const {
  camera.check();
  require_finite(baseline_m, "calibration.baseline_m");
  if (baseline_m < 0) throw ArgumentError("calibration.baseline_m: negative");
  if (depth) {
    depth->camera.check();
    require_positive(depth->sigma_at_1m, "calibration.depth.sigma_at_1m");
    if (!depth->T_cam_depth.translation().allFinite() ||
        !depth->T_cam_depth.rotation().quaternion().coeffs().allFinite())
      throw ArgumentError("calibration.depth.T_cam_depth: not finite");
  }
  if (camera_height_m) require_positive(*camera_height_m, "calibration.camera_height_m");
}

}  // namespace placegraph
