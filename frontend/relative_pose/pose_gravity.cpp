#include <placegraph/frontend/relative_pose/epipolar_error.h>
#include <placegraph/frontend/relative_pose/epipolar_refinement.h>
#include <placegraph/frontend/relative_pose/relative_pose.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/ransac.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <optional>

namespace placegraph {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Coefficients by rising powers of q.
using Quadratic = std::array<double, 3>;
using Sextic = Eigen::Matrix<double, 7, 1>;

struct LevelViews {
  const Camera& camera;
  std::vector<Vector3d> x_ref, x_cur;  // rays with z = 1
  Matrix3d R_level_ref, R_level_cur;   // rotates down to (0, 1, 0)
};

/// (1 + q^2) R_y(q) y_cur x y_ref.
std::array<Quadratic, 3> constraint_row(const Vector3d& y_cur, const Vector3d& y_ref) {
  const Quadratic x{y_cur.x(), 2 * y_cur.z(), -y_cur.x()};
  const Quadratic y{y_cur.y(), 0, y_cur.y()};
  const Quadratic z{y_cur.z(), -2 * y_cur.x(), -y_cur.z()};
  std::array<Quadratic, 3> row;
  for (int k = 0; k < 3; ++k) {
    row[0][k] = y[k] * y_ref.z() - z[k] * y_ref.y();
    row[1][k] = z[k] * y_ref.x() - x[k] * y_ref.z();
    row[2][k] = x[k] * y_ref.y() - y[k] * y_ref.x();
  }
  return row;
}

void add_product(const Quadratic& a, const Quadratic& b, const Quadratic& c, double sign,
                 Sextic& sum) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) sum[i + j + k] += sign * a[i] * b[j] * c[k];
}

/// Real roots of the quartic c0 + ... + c4 q^4, as eigenvalues of its companion matrix.
std::vector<double> real_roots(const Eigen::Matrix<double, 5, 1>& c) {
  std::vector<double> roots;
  if (!(std::abs(c[4]) > 1e-12 * c.cwiseAbs().maxCoeff())) return roots;
  Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
  companion.bottomLeftCorner<3, 3>().setIdentity();
  companion.col(3) = -c.head<4>() / c[4];
  const Eigen::EigenSolver<Eigen::Matrix4d> eigen(companion, false);
  for (const auto& root : eigen.eigenvalues())
    if (std::abs(root.imag()) < 1e-6 * (1 + std::abs(root.real()))) roots.push_back(root.real());
  return roots;
}

std::vector<SE3> solve_three_points(const LevelViews& views, const std::vector<int>& sample) {
  std::array<std::array<Quadratic, 3>, 3> M;
  for (int i = 0; i < 3; ++i)
    M[i] = constraint_row(views.R_level_cur * views.x_cur[sample[i]],
                          views.R_level_ref * views.x_ref[sample[i]]);
  Sextic det = Sextic::Zero();
  for (int k = 0; k < 3; ++k) {
    add_product(M[0][k], M[1][(k + 1) % 3], M[2][(k + 2) % 3], 1, det);
    add_product(M[0][k], M[1][(k + 2) % 3], M[2][(k + 1) % 3], -1, det);
  }
  // det is a multiple of 1 + q^2: at q = i all rows are orthogonal to (1, 0, -i).
  Eigen::Matrix<double, 5, 1> quartic;
  quartic[4] = det[6];
  quartic[3] = det[5];
  quartic[2] = det[4] - quartic[4];
  quartic[1] = det[3] - quartic[3];
  quartic[0] = det[2] - quartic[2];
  std::vector<SE3> models;
  for (const double q : real_roots(quartic)) {
    std::array<Vector3d, 3> rows;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        rows[i][k] = (M[i][k][0] + q * (M[i][k][1] + q * M[i][k][2])) / (1 + q * q);
    Vector3d t = rows[0].cross(rows[1]);
    for (const Vector3d& other : {rows[1].cross(rows[2]), rows[2].cross(rows[0])})
      if (other.norm() > t.norm()) t = other;
    if (!(t.norm() > 1e-12)) continue;
    const SO3 heading = SO3::exp(2 * std::atan(q) * Vector3d::UnitY());
    models.emplace_back(views.R_level_ref.transpose() * heading.matrix() * views.R_level_cur,
                        views.R_level_ref.transpose() * t.normalized());
  }
  return models;
}

/// Refines on the epipolar errors and on the verticals: R down_cur = down_ref.
SE3 refine(const LevelViews& views, const std::vector<int>& indices, const SE3& T_start,
           const GravityPoseOptions& o, double sigma_px, int iterations, Matrix6d* information) {
  const Vector3d down_ref = views.R_level_ref.row(1), down_cur = views.R_level_cur.row(1);
  const double sigma_down = deg_to_rad(std::sqrt(2.0) * o.sigma_gravity_deg);
  const auto verticals = [&](const SE3& T, Matrix6d& H, Vector6d& g) {
    // d (R exp(w) down_cur) / dw = -R hat(down_cur); about the vertical itself it is zero.
    const Matrix3d R = T.rotation().matrix();
    const Matrix3d J_down = -R * hat(down_cur) / sigma_down;
    H.bottomRightCorner<3, 3>() += J_down.transpose() * J_down;
    g.tail<3>() += J_down.transpose() * (R * down_cur - down_ref) / sigma_down;
  };
  return refine_epipolar(views.camera, views.x_ref, views.x_cur, indices, T_start,
                         {o.threshold_px / 2, sigma_px, iterations}, information, verticals);
}

}  // namespace

GravityPoseResult estimate_pose_with_gravity(const Camera& camera,
                                             const std::vector<Eigen::Vector2d>& px_ref,
                                             const std::vector<Eigen::Vector2d>& px_cur,
                                             const Vector3d& down_ref, const Vector3d& down_cur,
                                             const GravityPoseOptions& options, Random& random) {
  options.check();
  require(px_ref.size() == px_cur.size(),
          "estimate_pose_with_gravity: as many pixels in both views needed");
  require(std::abs(down_ref.norm() - 1) < 1e-6 && std::abs(down_cur.norm() - 1) < 1e-6,
          "estimate_pose_with_gravity: down must be of unit length");
  const auto level = [](const Vector3d& down) {
    return Eigen::Quaterniond::FromTwoVectors(down, Vector3d::UnitY()).toRotationMatrix();
  };
  const LevelViews views{camera, rays_of(camera, px_ref), rays_of(camera, px_cur), level(down_ref),
                         level(down_cur)};
  const int n = static_cast<int>(px_ref.size());
  std::optional<EpipolarError> of_last;
  const SE3* last = nullptr;
  const auto squared_error = [&](const SE3& T_ref_cur, int i) {
    if (&T_ref_cur != last || i == 0) {
      last = &T_ref_cur;
      of_last.emplace(camera, T_ref_cur);
    }
    const double e = (*of_last)(views.x_ref[i], views.x_cur[i]);
    return e * e;
  };
  const auto consensus = ransac<SE3>(
      n, 3, options.threshold_px * options.threshold_px, options.ransac, random,
      [&](const std::vector<int>& sample) { return solve_three_points(views, sample); },
      squared_error,
      [&](const SE3& T_ref_cur, const std::vector<int>& inliers) {
        return refine(views, inliers, T_ref_cur, options, options.threshold_px / 2, 3, nullptr);
      });
  GravityPoseResult result;
  result.outcome = consensus.outcome;
  result.inliers = consensus.inliers;
  if (!consensus.outcome) return result;
  SE3 T =
      refine(views, result.inliers, consensus.model, options, options.threshold_px / 2, 6, nullptr);
  result.rmse_px = epipolar_rmse_px(camera, views.x_ref, views.x_cur, result.inliers, T);
  // The residuals of a few points may be small by chance: sigma is at least 0.1 px.
  T = refine(views, result.inliers, T, options, std::max(0.1, result.rmse_px), 2,
             &result.information);
  const TwoViewParallax parallax =
      two_view_parallax(camera, T, views.x_ref, views.x_cur, result.inliers);
  if (parallax.behind > parallax.ahead) {
    T = SE3(T.rotation(), -T.translation());
    // The translational part of the tangent is rotated, too.
    result.information.topRightCorner<3, 3>() *= -1;
    result.information.bottomLeftCorner<3, 3>() *= -1;
  }
  result.T_ref_cur = T;
  result.parallax_px = parallax.median_px;
  if (parallax.median_px < options.min_parallax_px)
    result.outcome = Outcome::failure(Outcome::Code::kDegenerate,
                                      "a parallax of " + std::to_string(parallax.median_px) +
                                          " px does not determine a translation");
  return result;
}

}  // namespace placegraph
