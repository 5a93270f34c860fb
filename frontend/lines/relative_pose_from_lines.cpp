#include <placegraph/frontend/lines/relative_pose_from_lines.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>
#include <optional>
#include <string>

namespace placegraph {
namespace {

Outcome too_few(std::size_t have, const std::string& needed) {
  return Outcome::failure(Outcome::Code::kTooFewData,
                          std::to_string(have) + " lines, " + needed + " needed");
}

/// m_3^T t_31 - beta m_2^T t_21 as a row over [t_21, t_31], the normals m_2 and m_3 rotated into
/// the first camera's axes as n_2 and n_3.
std::optional<Eigen::Matrix<double, 1, 6>> three_view_row(const LineNormals& m, const SO3& R_21,
                                                          const SO3& R_31,
                                                          double least_rotation_rad) {
  const Eigen::Vector3d n_2 = R_21.inverse() * m[1], n_3 = R_31.inverse() * m[2];
  const Eigen::Vector3d across = m[0].cross(n_2);
  const double square = across.squaredNorm();
  if (!(square > least_rotation_rad * least_rotation_rad)) return std::nullopt;
  const double beta = m[0].cross(n_3).dot(across) / square;
  Eigen::Matrix<double, 1, 6> row;
  row << -beta * m[1].transpose(), m[2].transpose();
  return row;
}

/// Variance of a row's product with x for independent errors of the three normals.
double row_variance(const LineNormals& m, const SO3& R_21, const SO3& R_31,
                    const Eigen::Matrix<double, 6, 1>& x, double sigma_rad) {
  // Step of the difference quotient. Chosen, well above rounding.
  constexpr double kStep = 1e-6;
  const auto base = three_view_row(m, R_21, R_31, 0);
  double variance = 0;
  for (int view = 0; view < 3; ++view) {
    const Eigen::Vector3d a = m[view].unitOrthogonal(), b = m[view].cross(a);
    for (const Eigen::Vector3d& side : {a, b}) {
      LineNormals moved = m;
      moved[view] = (m[view] + kStep * side).normalized();
      const auto row = three_view_row(moved, R_21, R_31, 0);
      if (!row || !base) return 1e12;
      const double slope = (*row - *base).dot(x.transpose()) / kStep;
      variance += slope * slope * sigma_rad * sigma_rad;
    }
  }
  return variance;
}

/// Intersection of a line's plane with a plane at distance d: normal in the plane and offset.
struct InPlane {
  Eigen::Vector3d normal;
  double offset = 0, sigma = 0;
};
std::optional<InPlane> in_plane(const Eigen::Vector3d& m, const Eigen::Vector3d& n, double d,
                                double sigma_rad) {
  const double along = n.dot(m);
  const Eigen::Vector3d flat = m - along * n;
  constexpr double kLeast = 0.02;  // below this the line is beyond fifty heights
  if (!(flat.norm() > kLeast)) return std::nullopt;
  const double slope = along / flat.norm();
  return InPlane{flat.normalized(), -slope * d, d * (1 + slope * slope) * sigma_rad};
}

}  // namespace

RotationFromDirections rotation_from_directions(const std::vector<DirectionPair>& pairs,
                                                const SO3& R_cur_ref_guess) {
  RotationFromDirections result;
  result.R_cur_ref = R_cur_ref_guess;
  if (pairs.empty()) {
    result.outcome = Outcome::failure(Outcome::Code::kTooFewData, "no directions");
    return result;
  }
  Eigen::Matrix3d B = Eigen::Matrix3d::Zero();
  for (const DirectionPair& pair : pairs) {
    require(pair.sigma_rad > 0, "rotation_from_directions: sigma_rad must be positive");
    const double w = 1 / (pair.sigma_rad * pair.sigma_rad);
    const Eigen::Vector3d ref = pair.ref.normalized(), cur = pair.cur.normalized();
    const double sign = cur.dot(R_cur_ref_guess * ref) < 0 ? -1 : 1;
    B += w * sign * cur * ref.transpose();
    result.information += w * (Eigen::Matrix3d::Identity() - ref * ref.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(result.information);
  if (!(eigen.eigenvalues()[0] > 1e-6 * eigen.eigenvalues()[2])) {
    // The rotation nearest to the guess that aligns the one direction.
    const DirectionPair& pair = pairs.front();
    const Eigen::Vector3d from = (R_cur_ref_guess * pair.ref).normalized();
    const Eigen::Vector3d to = (from.dot(pair.cur) < 0 ? -1 : 1) * pair.cur.normalized();
    result.R_cur_ref = SO3(Eigen::Quaterniond::FromTwoVectors(from, to)) * R_cur_ref_guess;
    result.outcome =
        Outcome::failure(Outcome::Code::kDegenerate,
                         "directions are parallel: the rotation about them is undetermined");
    return result;
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(B, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d& U = svd.matrixU();
  const Eigen::Matrix3d& V = svd.matrixV();
  const double mirror = (U * V.transpose()).determinant() < 0 ? -1 : 1;
  result.R_cur_ref =
      SO3::from_matrix(U * Eigen::Vector3d(1, 1, mirror).asDiagonal() * V.transpose());
  result.outcome = Outcome::ok();
  return result;
}

TranslationFromLines translation_from_three_views(const std::vector<LineNormals>& lines,
                                                  const SO3& R_21, const SO3& R_31,
                                                  double sigma_rad) {
  require(sigma_rad > 0, "translation_from_three_views: sigma_rad must be positive");
  // Six unknowns up to scale.
  constexpr int kNeeded = 5;
  constexpr double kLeastRotationSigmas = 12;  // below, the error of beta is no longer proportional
  TranslationFromLines result;
  Eigen::MatrixXd A(static_cast<Eigen::Index>(lines.size()), 6);
  std::vector<const LineNormals*> used;
  for (const LineNormals& line : lines)
    if (const auto row = three_view_row(line, R_21, R_31, kLeastRotationSigmas * sigma_rad)) {
      A.row(static_cast<Eigen::Index>(used.size())) = *row;
      used.push_back(&line);
    }
  const auto n = static_cast<Eigen::Index>(used.size());
  if (n < kNeeded) {
    result.outcome = too_few(used.size(), "five that move between the first two views are");
    return result;
  }
  Eigen::MatrixXd W = A.topRows(n);
  Eigen::Matrix<double, 6, 1> x = Eigen::Matrix<double, 6, 1>::Constant(1 / std::sqrt(6.0));
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen;
  // Chosen.
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    for (Eigen::Index i = 0; i < n; ++i)
      W.row(i) = A.row(i) / std::sqrt(row_variance(*used[i], R_21, R_31, x, sigma_rad));
    eigen.compute(W.transpose() * W);
    x = eigen.eigenvectors().col(0);
  }
  result.t_21 = x.head<3>();
  result.t_31 = x.tail<3>();
  const double left = std::sqrt(std::max(0.0, eigen.eigenvalues()[0]));
  const double noise = std::sqrt(static_cast<double>(std::max<Eigen::Index>(1, n - kNeeded)));
  result.condition = std::sqrt(std::max(0.0, eigen.eigenvalues()[1])) / std::max(left, noise);
  result.rms_sigmas = left / noise;
  for (int k = 1; k < 6; ++k) {
    const auto axis = eigen.eigenvectors().col(k);
    result.covariance += axis * axis.transpose() / std::max(1e-30, eigen.eigenvalues()[k]);
  }
  // Ratio of deviations: the solution stands out by four. Chosen.
  constexpr double kLeastCondition = 4;
  result.outcome = result.condition > kLeastCondition
                       ? Outcome::ok()
                       : Outcome::failure(Outcome::Code::kDegenerate,
                                          "the lines show no translation between the three views");
  return result;
}

Outcome translation_from_two_views(std::size_t lines) {
  return Outcome::failure(Outcome::Code::kDegenerate,
                          "unobservable: two views of " + std::to_string(lines) +
                              " lines do not determine the translation, a third view is needed");
}

MotionOnPlane motion_from_floor_lines(const std::vector<PlaneLineObservation>& lines,
                                      const Plane3& plane_ref, double height_cur,
                                      const SO3& R_cur_ref) {
  const double sign = plane_ref.distance() < 0 ? -1 : 1;
  const Eigen::Vector3d n = sign * plane_ref.normal();
  const double height_ref = sign * plane_ref.distance();
  require(height_ref > 0 && height_cur > 0,
          "motion_from_floor_lines: both views need a positive distance to the plane");
  const Eigen::Vector3d e1 = n.unitOrthogonal(), e2 = n.cross(e1);
  Eigen::Matrix<double, 3, 2> E;
  E << e1, e2;
  MotionOnPlane result;
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
  Eigen::Vector2d g = Eigen::Vector2d::Zero();
  for (const PlaneLineObservation& line : lines) {
    const auto a = in_plane(line.normal_ref, n, height_ref, line.sigma_rad);
    auto b = in_plane(R_cur_ref.inverse() * line.normal_cur, n, height_cur, line.sigma_rad);
    if (!a || !b) continue;
    if (a->normal.dot(b->normal) < 0) b->normal = -b->normal, b->offset = -b->offset;
    const Eigen::Vector2d row = E.transpose() * (a->normal + b->normal).normalized();
    const double w = 1 / (a->sigma * a->sigma + b->sigma * b->sigma);
    H += w * row * row.transpose();
    g += w * (a->offset - b->offset) * row;
    ++result.lines;
  }
  if (result.lines < 2) {
    result.outcome = too_few(static_cast<std::size_t>(result.lines), "two on the plane are");
    return result;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(H);
  constexpr double kParallel = 1e-3;  // (sine of about two degrees)^2
  const bool open = !(eigen.eigenvalues()[0] > kParallel * eigen.eigenvalues()[1]);
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (int k = open ? 1 : 0; k < 2; ++k)
    covariance += eigen.eigenvectors().col(k) * eigen.eigenvectors().col(k).transpose() /
                  eigen.eigenvalues()[k];
  result.covariance = E * covariance * E.transpose();
  result.displacement_ref = E * (covariance * g) + (height_ref - height_cur) * n;
  result.outcome =
      open ? Outcome::failure(Outcome::Code::kDegenerate,
                              "lines of one direction: the displacement along them is undetermined")
           : Outcome::ok();
  return result;
}

}  // namespace placegraph
