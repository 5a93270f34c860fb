#include <placegraph/frontend/flow/flow_cues.h>
#include <placegraph/graph/core/median.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Code = Outcome::Code;

constexpr double kLeastSigma_px = 0.02;
constexpr double kTukey = 4.685;  // 95 % of the efficiency of least squares

/// Robust least squares of y_i = A_i x with 2-vectors y_i of known covariance.
struct Fit {
  VectorXd x;
  MatrixXd information;  // A^T W A, robust weights included
  VectorXd weights;      // one an observation
  double scale = 1;      // of the deviations, at least 1
  double chi2_per_dof = 0;
  bool degenerate = false;
};

struct Row {
  Eigen::Matrix<double, 2, Eigen::Dynamic> A;
  Vector2d y;
  Matrix2d information;
};

double mahalanobis(const Row& row, const VectorXd& x) {
  const Vector2d e = row.y - row.A * x;
  return std::sqrt(e.dot(row.information * e));
}

Fit fit(const std::vector<Row>& rows) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  const Eigen::Index unknowns = rows[0].A.cols();
  Fit result;
  result.x = VectorXd::Zero(unknowns);
  result.weights = VectorXd::Ones(n);
  constexpr int kIterations = 20;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    MatrixXd normal = MatrixXd::Zero(unknowns, unknowns);
    VectorXd right = VectorXd::Zero(unknowns);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Row& row = rows[static_cast<std::size_t>(i)];
      normal += result.weights[i] * row.A.transpose() * row.information * row.A;
      right += result.weights[i] * row.A.transpose() * row.information * row.y;
    }
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(normal);
    constexpr double kLeastCondition = 1e-9;
    if (!(eigen.eigenvalues()[0] > kLeastCondition * eigen.eigenvalues()[unknowns - 1])) {
      result.degenerate = true;
      return result;
    }
    const VectorXd before = result.x;
    result.x = normal.ldlt().solve(right);
    result.information = normal;
    std::vector<double> deviations;
    for (const Row& row : rows) deviations.push_back(mahalanobis(row, result.x));
    // Of two normal coordinates the median distance is 1.177 deviations.
    result.scale = std::max(1.0, median_of(deviations) / 1.1774);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double r = deviations[static_cast<std::size_t>(i)] / (kTukey * result.scale);
      result.weights[i] = r < 1 ? (1 - r * r) * (1 - r * r) : 0;
    }
    if (iteration > 1 && (result.x - before).norm() <= 1e-9 * (1 + result.x.norm())) break;
  }
  double chi2 = 0, support = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double d = mahalanobis(rows[static_cast<std::size_t>(i)], result.x);
    chi2 += result.weights[i] * d * d;
    support += result.weights[i];
  }
  result.chi2_per_dof = chi2 / std::max(1.0, 2 * support - static_cast<double>(unknowns));
  return result;
}

/// What vectors leave open where they err more than they say.
MatrixXd covariance_of(const Fit& fitted) {
  return fitted.information.inverse() * std::max(1.0, fitted.chi2_per_dof);
}

Outcome too_few(std::size_t count, std::size_t least) {
  return Outcome::failure(Code::kTooFewData, std::to_string(count) + " vectors of flow, " +
                                                 std::to_string(least) + " needed");
}

}  // namespace

std::vector<DerotatedFlow> derotate(const Camera& camera, const std::vector<FlowVector>& flow,
                                    const KnownRotation& rotation) {
  std::vector<DerotatedFlow> result;
  for (const FlowVector& vector : flow) {
    if (vector.kind != FlowVector::Kind::kFull) continue;
    const auto start = camera.unproject(vector.px);
    const auto seen = camera.unproject(vector.px + vector.flow);
    if (!start || !seen) continue;
    const Vector3d ray = rotation.R_1_2 * *seen;
    if (!(ray.z() > 0.05)) continue;
    DerotatedFlow out;
    out.start = start->head<2>();
    out.end = ray.hnormalized();
    Eigen::Matrix<double, 2, 3> J_end_ray;
    J_end_ray << 1 / ray.z(), 0, -out.end.x() / ray.z(), 0, 1 / ray.z(), -out.end.y() / ray.z();
    const Matrix3d R = rotation.R_1_2.matrix();
    Matrix2d covariance_px = vector.covariance;
    covariance_px.diagonal().array() += kLeastSigma_px * kLeastSigma_px;
    const Vector2d focal(camera.fx, camera.fy);
    const Eigen::Matrix<double, 2, 2> J_end_px =
        J_end_ray * R.leftCols<2>() * focal.cwiseInverse().asDiagonal();
    out.covariance = J_end_px * covariance_px * J_end_px.transpose();
    out.J_end_rotation = -J_end_ray * R * hat(*seen);
    result.push_back(out);
  }
  return result;
}

VentralMotion ventral_motion(const std::vector<DerotatedFlow>& flow, const Vector3d& normal,
                             const Matrix3d& rotation_covariance) {
  VentralMotion result;
  constexpr std::size_t kLeast = 6;
  if (std::abs(normal.norm() - 1) > 1e-6) {
    result.outcome = Outcome::failure(Code::kInconsistent, "the plane's normal is no unit vector");
    return result;
  }
  // With X the point over the plane's distance and c the camera's way over it, the second view is
  // X - c: end = (X - c)_xy / (X - c)_z, which is linear in c. X = start / (normal . start).
  std::vector<Row> rows;
  std::vector<const DerotatedFlow*> used;
  for (const DerotatedFlow& f : flow) {
    const double inverse = normal.dot(f.start.homogeneous());
    if (!(inverse > 0.02)) continue;  // at or beyond the plane's horizon
    Row row{Eigen::Matrix<double, 2, 3>(), f.flow(), f.covariance.inverse()};
    row.A << -inverse, 0, inverse * f.end.x(), 0, -inverse, inverse * f.end.y();
    rows.push_back(row);
    used.push_back(&f);
  }
  if (rows.size() < kLeast) {
    result.outcome = too_few(rows.size(), kLeast);
    return result;
  }
  const Fit fitted = fit(rows);
  if (fitted.degenerate) {
    result.outcome = Outcome::failure(Code::kDegenerate, "the points leave a direction open");
    return result;
  }
  result.over_distance = fitted.x;
  result.chi2_per_dof = fitted.chi2_per_dof;
  // An error of the turn moves all points together.
  Matrix3d J = Matrix3d::Zero();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double weight = fitted.weights[static_cast<Eigen::Index>(i)];
    result.inliers += weight > 0;
    J += weight * rows[i].A.transpose() * rows[i].information * used[i]->J_end_rotation;
  }
  result.J_rotation = fitted.information.ldlt().solve(J);
  result.covariance = covariance_of(fitted) +
                      result.J_rotation * rotation_covariance * result.J_rotation.transpose();
  constexpr double kLeastSupport = 0.4;
  result.outcome = result.inliers < kLeastSupport * static_cast<double>(rows.size())
                       ? Outcome::failure(Code::kNoConsensus, "most vectors contradict a plane")
                       : Outcome::ok();
  return result;
}

TimeToContact time_to_contact(const VentralMotion& motion, const Vector3d& normal, double dt) {
  TimeToContact result;
  if (!motion.outcome) {
    result.outcome = motion.outcome;
    return result;
  }
  const double closing = normal.dot(motion.over_distance);  // of the distance, per image
  const double sigma = std::sqrt(normal.dot(motion.covariance * normal));
  if (!(dt > 0 && closing > 3 * sigma)) {
    result.outcome = Outcome::failure(Code::kInconsistent, "no motion towards the plane");
    return result;
  }
  result.seconds = dt * (1 - closing) / closing;
  result.sigma = dt * sigma / (closing * closing);
  result.outcome = Outcome::ok();
  return result;
}

AffineFlow affine_flow(const std::vector<DerotatedFlow>& flow) {
  AffineFlow result;
  constexpr std::size_t kLeast = 6;
  if (flow.size() < kLeast) {
    result.outcome = too_few(flow.size(), kLeast);
    return result;
  }
  std::vector<Row> rows;
  for (const DerotatedFlow& f : flow) {
    Row row{Eigen::Matrix<double, 2, 6>::Zero(), f.flow(), f.covariance.inverse()};
    row.A.block<1, 3>(0, 0) << 1, f.start.x(), f.start.y();
    row.A.block<1, 3>(1, 3) << 1, f.start.x(), f.start.y();
    rows.push_back(row);
  }
  const Fit fitted = fit(rows);
  if (fitted.degenerate) {
    result.outcome = Outcome::failure(Code::kDegenerate, "the points lie in a line");
    return result;
  }
  result.centre = {fitted.x[0], fitted.x[3]};
  result.gradient << fitted.x[1], fitted.x[2], fitted.x[4], fitted.x[5];
  const MatrixXd covariance = covariance_of(fitted);
  result.sigma_divergence = std::sqrt(covariance(1, 1) + covariance(5, 5) + 2 * covariance(1, 5));
  result.outcome = Outcome::ok();
  return result;
}

LateralBalance lateral_balance(const std::vector<DerotatedFlow>& flow) {
  LateralBalance result;
  double sums[2] = {}, variances[2] = {};
  std::size_t counts[2] = {};
  for (const DerotatedFlow& f : flow) {
    const int side = f.start.x() > 0;
    const double length = f.flow().norm();
    sums[side] += length;
    if (length > 0) {
      const Vector2d along = f.flow() / length;
      variances[side] += along.dot(f.covariance * along);
    }
    ++counts[side];
  }
  constexpr std::size_t kLeast = 3;
  if (std::min(counts[0], counts[1]) < kLeast) {
    result.outcome = too_few(std::min(counts[0], counts[1]), kLeast);
    return result;
  }
  const auto n_left = static_cast<double>(counts[0]), n_right = static_cast<double>(counts[1]);
  result.left = sums[0] / n_left;
  result.right = sums[1] / n_right;
  const double sum = result.left + result.right;
  const double variance_left = variances[0] / (n_left * n_left);
  const double variance_right = variances[1] / (n_right * n_right);
  if (!(sum > 3 * std::sqrt(variance_left + variance_right))) {
    result.outcome = Outcome::failure(Code::kDegenerate, "hardly anything moves");
    return result;
  }
  result.balance = (result.right - result.left) / sum;
  result.sigma = 2 / (sum * sum) *
                 std::sqrt(result.left * result.left * variance_right +
                           result.right * result.right * variance_left);
  result.outcome = Outcome::ok();
  return result;
}

}  // namespace placegraph
