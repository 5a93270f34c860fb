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

// Least noise of a vector. Chosen.
constexpr double kLeastSigma_px = 0.02;
constexpr double kTukey = 4.685;  // 95 % of the efficiency of least squares

/// Robust least squares of y_i = A_i x with 2-vectors y_i of known covariance.
struct Fit {
  VectorXd x;
  MatrixXd information;  // A^T W A, robust weights included
  VectorXd weights;      // one per observation
  double scale = 1;      // factor of the standard deviations, at least 1
  double chi2_per_dof = 0;
  bool degenerate = false;
};

struct FlowRow {
  Eigen::Matrix<double, 2, Eigen::Dynamic> A;
  Vector2d y;
  Matrix2d information;
};

double mahalanobis(const FlowRow& row, const VectorXd& x) {
  const Vector2d e = row.y - row.A * x;
  return std::sqrt(e.dot(row.information * e));
}

Fit fit(const std::vector<FlowRow>& rows) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  const Eigen::Index unknowns = rows[0].A.cols();
  Fit result;
  result.x = VectorXd::Zero(unknowns);
  result.weights = VectorXd::Ones(n);
  // Iterations at most. Chosen.
  constexpr int kIterations = 20;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    MatrixXd normal = MatrixXd::Zero(unknowns, unknowns);
    VectorXd right = VectorXd::Zero(unknowns);
    for (Eigen::Index i = 0; i < n; ++i) {
      const FlowRow& row = rows[static_cast<std::size_t>(i)];
      normal += result.weights[i] * row.A.transpose() * row.information * row.A;
      right += result.weights[i] * row.A.transpose() * row.information * row.y;
    }
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(normal);
    // Ratio of eigenvalues of an undetermined direction. Chosen.
    constexpr double kLeastCondition = 1e-9;
    if (!(eigen.eigenvalues()[0] > kLeastCondition * eigen.eigenvalues()[unknowns - 1])) {
      result.degenerate = true;
      return result;
    }
    const VectorXd before = result.x;
    result.x = normal.ldlt().solve(right);
    result.information = normal;
    std::vector<double> deviations;
    for (const FlowRow& row : rows) deviations.push_back(mahalanobis(row, result.x));
    // The median distance of two normal coordinates is 1.177 standard deviations.
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

/// Covariance of the fit, scaled if the residuals exceed the vectors' stated covariance.
MatrixXd covariance_of(const Fit& fitted) {
  return fitted.information.inverse() * std::max(1.0, fitted.chi2_per_dof);
}

/// Derivative of the fit by the right tangent of the removed rotation, whose error is common to all
/// points.
MatrixXd by_rotation(const Fit& fitted, const std::vector<FlowRow>& rows,
                     const std::vector<const DerotatedFlow*>& flow) {
  MatrixXd J = MatrixXd::Zero(fitted.x.size(), 3);
  for (std::size_t i = 0; i < rows.size(); ++i)
    J += fitted.weights[static_cast<Eigen::Index>(i)] * rows[i].A.transpose() *
         rows[i].information * flow[i]->J_end_rotation;
  return fitted.information.ldlt().solve(J);
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
  // Vectors of two numbers each, for at most six unknowns: twice as many.
  constexpr std::size_t kLeast = 6;
  if (std::abs(normal.norm() - 1) > 1e-6) {
    result.outcome =
        Outcome::failure(Code::kInconsistent, "the plane's normal is not a unit vector");
    return result;
  }
  // With X the point and c the camera's translation, both over the plane's distance, the second
  // view is X - c: end = (X - c)_xy / (X - c)_z, which is linear in c. X = start / (normal .
  // start).
  std::vector<FlowRow> rows;
  std::vector<const DerotatedFlow*> used;
  for (const DerotatedFlow& f : flow) {
    const double inverse = normal.dot(f.start.homogeneous());
    if (!(inverse > 0.02)) continue;  // at or beyond the plane's horizon
    FlowRow row{Eigen::Matrix<double, 2, 3>(), f.flow(), f.covariance.inverse()};
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
    result.outcome =
        Outcome::failure(Code::kDegenerate, "the points leave a direction undetermined");
    return result;
  }
  result.over_distance = fitted.x;
  result.chi2_per_dof = fitted.chi2_per_dof;
  result.inliers = static_cast<int>((fitted.weights.array() > 0).count());
  result.J_rotation = by_rotation(fitted, rows, used);
  result.covariance = covariance_of(fitted) +
                      result.J_rotation * rotation_covariance * result.J_rotation.transpose();
  // Share of the vectors on the plane. Chosen.
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
  const double closing = normal.dot(motion.over_distance);  // share of the distance per image
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

AffineFlow affine_flow(const std::vector<DerotatedFlow>& flow,
                       const Matrix3d& rotation_covariance) {
  AffineFlow result;
  // Vectors of two numbers each, for six unknowns: twice as many.
  constexpr std::size_t kLeast = 6;
  if (flow.size() < kLeast) {
    result.outcome = too_few(flow.size(), kLeast);
    return result;
  }
  std::vector<FlowRow> rows;
  for (const DerotatedFlow& f : flow) {
    FlowRow row{Eigen::Matrix<double, 2, 6>::Zero(), f.flow(), f.covariance.inverse()};
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
  std::vector<const DerotatedFlow*> used;
  for (const DerotatedFlow& f : flow) used.push_back(&f);
  const MatrixXd J = by_rotation(fitted, rows, used);
  result.covariance = covariance_of(fitted) + J * rotation_covariance * J.transpose();
  result.outcome = Outcome::ok();
  return result;
}

LateralBalance lateral_balance(const std::vector<DerotatedFlow>& flow,
                               const Matrix3d& rotation_covariance) {
  LateralBalance result;
  struct Side {
    double sum = 0, variance = 0;
    Eigen::RowVector3d J = Eigen::RowVector3d::Zero();  // derivative of `sum` by the rotation
    std::size_t count = 0;
  };
  Side left, right;
  for (const DerotatedFlow& f : flow) {
    Side& side = f.start.x() > 0 ? right : left;
    const double length = f.flow().norm();
    side.sum += length;
    ++side.count;
    if (!(length > 0)) continue;
    const Vector2d along = f.flow() / length;
    side.variance += along.dot(f.covariance * along);
    side.J += along.transpose() * f.J_end_rotation;
  }
  // Vectors on each side. Chosen.
  constexpr std::size_t kLeast = 3;
  if (std::min(left.count, right.count) < kLeast) {
    result.outcome = too_few(std::min(left.count, right.count), kLeast);
    return result;
  }
  for (Side* side : {&left, &right}) {
    const auto n = static_cast<double>(side->count);
    side->sum /= n;
    side->variance /= n * n;
    side->J /= n;
  }
  result.left = left.sum;
  result.right = right.sum;
  const double sum = left.sum + right.sum;
  const auto by_rotation = [&](const Eigen::RowVector3d& J) {
    return J.dot(rotation_covariance * J.transpose());
  };
  if (!(sum > 3 * std::sqrt(left.variance + right.variance + by_rotation(left.J + right.J)))) {
    result.outcome = Outcome::failure(Code::kDegenerate, "negligible flow");
    return result;
  }
  result.balance = (right.sum - left.sum) / sum;
  const double half_slope = 2 / (sum * sum);  // d balance = half_slope (left dr - right dl)
  result.sigma = half_slope * std::sqrt(left.sum * left.sum * right.variance +
                                        right.sum * right.sum * left.variance +
                                        by_rotation(left.sum * right.J - right.sum * left.J));
  result.outcome = Outcome::ok();
  return result;
}

}  // namespace placegraph
