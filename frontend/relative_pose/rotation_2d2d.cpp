#include <placegraph/frontend/relative_pose/rotation_2d2d.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/ransac.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <opengv/relative_pose/CentralRelativeAdapter.hpp>
#include <opengv/relative_pose/methods.hpp>
#include <string>

namespace placegraph {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

struct Rays {
  const Camera& camera;
  const std::vector<Vector2d>& px_cur;
  opengv::bearingVectors_t ref, cur;
};

/// Pixel of the current view minus the rotated pixel of the reference, if that has an image.
std::optional<Vector2d> residual_px(const Rays& rays, const Matrix3d& R_cur_ref, int i,
                                    Eigen::Matrix<double, 2, 3>* J = nullptr) {
  const Vector3d x = R_cur_ref * rays.ref[static_cast<std::size_t>(i)];
  Eigen::Matrix<double, 2, 3> by_x;
  const auto px = rays.camera.project(x, &by_x);
  if (!px) return std::nullopt;
  if (J) *J = -by_x * hat(x);  // R_ref_cur exp(w) rotates x by -w
  return rays.px_cur[static_cast<std::size_t>(i)] - *px;
}

struct Fit {
  SO3 R_ref_cur;
  Matrix3d normal = Matrix3d::Zero();
  double sum_px2 = 0;
  int count = 0;
  bool full = false;  // whether the pixels determine all three angles
};

/// Gauss-Newton on the pixels of the inliers.
Fit refine(const Rays& rays, const Matrix3d& start, const std::vector<int>& inliers) {
  Fit fit;
  fit.R_ref_cur = SO3(Eigen::Quaterniond(start));
  // Iterations. Chosen.
  constexpr int kIterations = 3;
  for (int iteration = 0; iteration <= kIterations; ++iteration) {
    fit.normal.setZero();
    fit.sum_px2 = fit.count = 0;
    Vector3d gradient = Vector3d::Zero();
    const Matrix3d R_cur_ref = fit.R_ref_cur.inverse().matrix();
    for (const int i : inliers) {
      Eigen::Matrix<double, 2, 3> J;
      const auto r = residual_px(rays, R_cur_ref, i, &J);
      if (!r) continue;
      fit.normal += J.transpose() * J;
      gradient += J.transpose() * *r;
      fit.sum_px2 += r->squaredNorm();
      ++fit.count;
    }
    const Eigen::LDLT<Matrix3d> solver(fit.normal);
    fit.full = fit.count > 1 && solver.rcond() > 1e-9;
    if (iteration == kIterations || !fit.full) break;
    fit.R_ref_cur = fit.R_ref_cur.plus(-solver.solve(gradient));
  }
  return fit;
}

}  // namespace

Rotation2d2dResult estimate_rotation_2d2d(const Camera& camera, const std::vector<Vector2d>& px_ref,
                                          const std::vector<Vector2d>& px_cur,
                                          const Rotation2d2dOptions& options, Random& random) {
  using Code = Outcome::Code;
  require(px_ref.size() == px_cur.size(),
          "estimate_rotation_2d2d: as many pixels in both views needed");
  Rays rays{camera, px_cur, {}, {}};
  for (std::size_t i = 0; i < px_ref.size(); ++i) {
    rays.ref.push_back(camera.unproject(px_ref[i]).value_or(Vector3d::UnitZ()).normalized());
    rays.cur.push_back(camera.unproject(px_cur[i]).value_or(Vector3d::UnitZ()).normalized());
  }
  const opengv::relative_pose::CentralRelativeAdapter adapter(rays.ref, rays.cur);
  const auto rotation = [&](const std::vector<int>& indices) -> Matrix3d {
    return indices.size() > 2 ? opengv::relative_pose::rotationOnly(adapter, indices)
                              : opengv::relative_pose::twopt_rotationOnly(adapter, indices);
  };
  const auto solve = [&](const std::vector<int>& sample) {
    const Matrix3d R_ref_cur = rotation(sample);
    return R_ref_cur.allFinite() ? std::vector<Matrix3d>{R_ref_cur} : std::vector<Matrix3d>{};
  };
  const auto error_px2 = [&](const Matrix3d& R_ref_cur, int i) {
    const auto r = residual_px(rays, R_ref_cur.transpose(), i);
    return r ? r->squaredNorm() : std::numeric_limits<double>::infinity();
  };
  const int n = static_cast<int>(px_ref.size());
  const auto found = ransac<Matrix3d>(
      n, 2, options.threshold_px * options.threshold_px, options.ransac, random, solve, error_px2,
      [&](const Matrix3d&, const std::vector<int>& inliers) { return rotation(inliers); });
  Rotation2d2dResult result;
  result.outcome = found.outcome;
  result.inliers = found.inliers;
  if (!found.outcome) return result;
  if (static_cast<double>(found.inliers.size()) < options.min_inlier_share * n) {
    result.outcome = Outcome::failure(
        Code::kInconsistent, std::to_string(found.inliers.size()) + " of " + std::to_string(n) +
                                 " points agree with a rotation: the camera translated");
    return result;
  }
  const Fit fit = refine(rays, found.model, found.inliers);
  if (!fit.full) {
    result.outcome = Outcome::failure(Code::kDegenerate, "all points are in one direction");
    return result;
  }
  result.R_ref_cur = fit.R_ref_cur;
  result.rmse_px = std::sqrt(fit.sum_px2 / fit.count);
  const double f = 0.5 * (camera.fx + camera.fy);
  const double variance_px2 = std::max(fit.sum_px2 / (2 * fit.count), 1e-6);
  result.covariance = variance_px2 * fit.normal.ldlt().solve(Matrix3d::Identity()) +
                      variance_px2 / (f * f) * Matrix3d::Identity();
  return result;
}

}  // namespace placegraph
