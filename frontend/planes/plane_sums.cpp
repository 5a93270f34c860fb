#include <placegraph/frontend/planes/plane_sums.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Relative size of the smallest pivot below which it is rounding: fewer than three independent
/// points.
constexpr double kTinyPivot = 1e-11;
/// Least distance of a plane, for one through the origin [m].
constexpr double kLeastDistance = 1e-9;

void set_plane(FittedPlane& fit, Eigen::Vector3d normal, double distance) {
  if (distance < 0) normal = -normal, distance = -distance;
  fit.plane = {normal, distance};
  fit.g = normal / std::max(distance, kLeastDistance);
}

}  // namespace

void PlaneSums::add(const FitPoint& point, const FitModel& model) {
  const double w = point.weight;
  n_ += 1;
  w_ += w;
  centre_q_ += w * point.q;
  const Eigen::Vector3d wq = w * point.q;
  M_(0, 0) += wq[0] * point.q[0], M_(1, 0) += wq[1] * point.q[0], M_(2, 0) += wq[2] * point.q[0];
  M_(1, 1) += wq[1] * point.q[1], M_(2, 1) += wq[2] * point.q[1], M_(2, 2) += wq[2] * point.q[2];
  if (model.noise == PointNoise::kIsotropic) return;
  v_ += wq * point.value;
  c_ += w * point.value * point.value;
}

PlaneSums& PlaneSums::operator+=(const PlaneSums& other) {
  n_ += other.n_, w_ += other.w_, c_ += other.c_;
  centre_q_ += other.centre_q_;
  v_ += other.v_;
  M_ += other.M_;
  return *this;
}

Eigen::Vector3d PlaneSums::centre() const { return w_ > 0 ? centre_q_ / w_ : centre_q_; }

FittedPlane PlaneSums::fit(const FitModel& model, bool with_covariance) const {
  FittedPlane result;
  if (n_ < 3) return result;
  Eigen::Matrix3d M = M_.selfadjointView<Eigen::Lower>();
  if (model.noise == PointNoise::kAlongRay) {
    const Eigen::LDLT<Eigen::Matrix3d> solver(M);
    const Eigen::Vector3d pivots = solver.vectorD();
    if (!(pivots.minCoeff() > kTinyPivot * pivots.maxCoeff())) return result;
    const Eigen::Vector3d g = solver.solve(v_);
    const double length = g.norm();
    if (!(length > 0) || !std::isfinite(length)) return result;
    set_plane(result, g / length, 1 / length);
    result.g = g;
    result.chi2 = std::max(0.0, c_ - g.dot(v_));
    if (with_covariance) {
      const Eigen::Matrix3d J =
          (Eigen::Matrix3d::Identity() - 2 * g * g.transpose() / (length * length)) /
          (length * length);
      result.covariance = J * solver.solve(Eigen::Matrix3d::Identity()) * J.transpose();
    }
    result.ok = true;
    return result;
  }
  const Eigen::Vector3d mean = centre();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(M - w_ * mean * mean.transpose());
  const Eigen::Vector3d values = eigen.eigenvalues();
  if (!(values[1] > kTinyPivot * std::max(values[2], w_ * mean.squaredNorm()))) return result;
  const Eigen::Vector3d normal = eigen.eigenvectors().col(0);
  set_plane(result, normal, normal.dot(mean));
  result.chi2 = std::max(0.0, values[0]);
  if (with_covariance) {
    const Eigen::Vector3d n = result.plane.normal;
    Eigen::Matrix3d of_normal = Eigen::Matrix3d::Zero();
    for (int k = 1; k < 3; ++k) {
      const Eigen::Vector3d e = eigen.eigenvectors().col(k);
      of_normal += e * e.transpose() / values[k];
    }
    const Eigen::Matrix3d J =
        n * mean.transpose() + result.plane.distance_m * Eigen::Matrix3d::Identity();
    result.covariance = J * of_normal * J.transpose() + n * n.transpose() / w_;
  }
  result.ok = true;
  return result;
}

double PlaneSums::misfit(const FittedPlane& fit, const FitModel& model) const {
  if (model.noise == PointNoise::kAlongRay) {
    const Eigen::Vector3d Mg = M_.selfadjointView<Eigen::Lower>() * fit.g;
    return std::max(0.0, c_ - 2 * fit.g.dot(v_) + fit.g.dot(Mg));
  }
  const Eigen::Vector3d& n = fit.plane.normal;
  const double d = fit.plane.distance_m;
  const Eigen::Vector3d Mn = M_.selfadjointView<Eigen::Lower>() * n;
  return std::max(0.0, n.dot(Mn) - 2 * d * n.dot(centre_q_) + d * d * w_);
}

double PlaneSums::inflation(const FittedPlane& fit, const FitModel& model) const {
  const double bend = model.flatness * (model.noise == PointNoise::kAlongRay ? fit.g.norm() : 1.0);
  return 1 + model.shared + bend * bend * w_ / std::max(n_, 1.0);
}

double residual_sigmas(const FittedPlane& fit, const FitPoint& point, const FitModel& model) {
  const bool ray = model.noise == PointNoise::kAlongRay;
  const double bend = model.flatness * (ray ? fit.g.norm() : 1.0);
  const double off =
      ray ? point.value - fit.g.dot(point.q) : fit.plane.normal.dot(point.q) - fit.plane.distance_m;
  return std::abs(off) / std::sqrt((1 + model.shared) / point.weight + bend * bend);
}

FittedPlane plane_through(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c) {
  FittedPlane fit;
  const Eigen::Vector3d u = b - a, v = c - a, across = u.cross(v);
  const double area = across.norm();
  if (!(area > 1e-6 * u.norm() * v.norm())) return fit;
  const Eigen::Vector3d normal = across / area;
  set_plane(fit, normal, normal.dot(a));
  fit.ok = true;
  return fit;
}

}  // namespace placegraph
