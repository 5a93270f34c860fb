#include <placegraph/frontend/relative_pose/pose_3d2d.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/ransac.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <limits>
#include <numeric>
#include <opengv/absolute_pose/CentralAbsoluteAdapter.hpp>
#include <opengv/absolute_pose/methods.hpp>

namespace placegraph {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double squared_error_px(const Camera& camera, const SE3& T_cam_ref,
                        const Eigen::Vector3d& point_ref, const Eigen::Vector2d& px) {
  const auto projected = camera.project(T_cam_ref * point_ref);
  return projected ? (*projected - px).squaredNorm() : kInfinity;
}

std::vector<int> inliers_of(const Camera& camera, const SE3& T_ref_cam,
                            const std::vector<Eigen::Vector3d>& points_ref,
                            const std::vector<Eigen::Vector2d>& px, double threshold_px) {
  const SE3 T_cam_ref = T_ref_cam.inverse();
  std::vector<int> inliers;
  for (std::size_t i = 0; i < px.size(); ++i)
    if (squared_error_px(camera, T_cam_ref, points_ref[i], px[i]) < threshold_px * threshold_px)
      inliers.push_back(static_cast<int>(i));
  return inliers;
}

Pose3d2dResult finish(const Camera& camera, const std::vector<Eigen::Vector3d>& points_ref,
                      const std::vector<Eigen::Vector2d>& px, const Pose3d2dOptions& options,
                      const SE3& T_start, std::vector<int> inliers) {
  Pose3d2dResult result;
  Matrix6d normal = Matrix6d::Zero();
  result.T_ref_cam = T_start;
  for (int round = 0; round < 2; ++round) {
    result.T_ref_cam = refine_pose_3d2d(camera, points_ref, px, inliers, result.T_ref_cam,
                                        options.threshold_px / 2, 6, &normal);
    inliers = inliers_of(camera, result.T_ref_cam, points_ref, px, options.threshold_px);
  }
  result.inliers = std::move(inliers);
  const int count = static_cast<int>(result.inliers.size());
  const SE3 T_cam_ref = result.T_ref_cam.inverse();
  double sum = 0;
  for (int i : result.inliers) sum += squared_error_px(camera, T_cam_ref, points_ref[i], px[i]);
  result.rmse_px = count ? std::sqrt(sum / (2.0 * count)) : 0;
  // The residuals of a few points may be small by chance: sigma is at least 0.3 px.
  const double sigma_px = std::max(0.3, result.rmse_px);
  result.information = normal / (sigma_px * sigma_px);
  if (count < options.ransac.min_inliers) {
    result.outcome =
        Outcome::failure(Outcome::Code::kNoConsensus,
                         std::to_string(count) + " inliers of " + std::to_string(px.size()));
    return result;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(normal, Eigen::EigenvaluesOnly);
  const bool invertible = eigen.eigenvalues()[0] > 1e-9 * eigen.eigenvalues()[5];
  result.outcome = invertible
                       ? Outcome::ok()
                       : Outcome::failure(Outcome::Code::kDegenerate,
                                          "the points do not determine all six degrees of freedom");
  return result;
}

/// RANSAC over poses from three points each (Kneip et al. 2011).
RansacResult<SE3> search_pose(const Camera& camera, const std::vector<Eigen::Vector3d>& points_ref,
                              const std::vector<Eigen::Vector2d>& px,
                              const Pose3d2dOptions& options, Random& random) {
  const int n = static_cast<int>(px.size());
  opengv::bearingVectors_t bearings(n);
  opengv::points_t points(n);
  for (int i = 0; i < n; ++i) {
    const auto ray = camera.unproject(px[i]);
    bearings[i] = ray ? ray->normalized() : Eigen::Vector3d::UnitZ();
    points[i] = points_ref[i];
  }
  const opengv::absolute_pose::CentralAbsoluteAdapter adapter(bearings, points);
  const auto solve = [&](const std::vector<int>& sample) {
    std::vector<SE3> models;
    for (const auto& T_ref_cam : opengv::absolute_pose::p3p_kneip(adapter, sample)) {
      const Eigen::Matrix3d R = T_ref_cam.leftCols<3>();
      if (!T_ref_cam.allFinite() || (R.transpose() * R - Eigen::Matrix3d::Identity()).norm() > 1e-3)
        continue;
      models.emplace_back(R, Eigen::Vector3d(T_ref_cam.col(3)));
    }
    return models;
  };
  // Points and inverse of the candidate are needed n times: keep the inverse of the last model.
  SE3 last, last_inverse;
  const auto error = [&](const SE3& T_ref_cam, int i) {
    if (T_ref_cam.translation() != last.translation() ||
        T_ref_cam.rotation().quaternion().coeffs() != last.rotation().quaternion().coeffs()) {
      last = T_ref_cam;
      last_inverse = T_ref_cam.inverse();
    }
    return squared_error_px(camera, last_inverse, points_ref[i], px[i]);
  };
  const auto refine = [&](const SE3& T_ref_cam, const std::vector<int>& inliers) {
    return refine_pose_3d2d(camera, points_ref, px, inliers, T_ref_cam, options.threshold_px / 2,
                            3);
  };
  return ransac<SE3>(n, 3, options.threshold_px * options.threshold_px, options.ransac, random,
                     solve, error, refine);
}

}  // namespace

SE3 refine_pose_3d2d(const Camera& camera, const std::vector<Eigen::Vector3d>& points_ref,
                     const std::vector<Eigen::Vector2d>& px, const std::vector<int>& indices,
                     const SE3& T_ref_cam, double huber_px, int iterations, Matrix6d* normal) {
  SE3 T = T_ref_cam;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const SE3 T_cam_ref = T.inverse();
    Matrix6d H = Matrix6d::Zero();
    Vector6d g = Vector6d::Zero();
    for (int i : indices) {
      const Eigen::Vector3d p_cam = T_cam_ref * points_ref[i];
      Eigen::Matrix<double, 2, 3> J_px_cam;
      const auto projected = camera.project(p_cam, &J_px_cam);
      if (!projected) continue;
      // p_cam = exp(-xi) T^-1 p:  d p_cam / d xi = [-I, hat(p_cam)]
      Eigen::Matrix<double, 3, 6> J_cam_xi;
      J_cam_xi << -Eigen::Matrix3d::Identity(), hat(p_cam);
      const Eigen::Matrix<double, 2, 6> J = J_px_cam * J_cam_xi;
      const Eigen::Vector2d r = *projected - px[i];
      const double norm = r.norm();
      const double weight = norm > huber_px ? huber_px / norm : 1;
      H.noalias() += weight * J.transpose() * J;
      g.noalias() += weight * J.transpose() * r;
    }
    if (normal) *normal = H;
    const Eigen::LDLT<Matrix6d> ldlt(H + 1e-9 * H.trace() * Matrix6d::Identity());
    const Vector6d step = -ldlt.solve(g);
    if (!step.allFinite()) break;
    T = T.plus(step);
    if (step.norm() < 1e-8) break;
  }
  return T;
}

Pose3d2dResult estimate_pose_3d2d(const Camera& camera,
                                  const std::vector<Eigen::Vector3d>& points_ref,
                                  const std::vector<Eigen::Vector2d>& px,
                                  const Pose3d2dOptions& options, Random& random,
                                  const SE3* prior) {
  require(points_ref.size() == px.size(), "estimate_pose_3d2d: as many points as pixels needed");
  const int n = static_cast<int>(px.size());
  if (n < std::max(4, options.ransac.min_inliers)) {
    Pose3d2dResult result;
    result.outcome =
        Outcome::failure(Outcome::Code::kTooFewData,
                         std::to_string(n) + " points, " +
                             std::to_string(std::max(4, options.ransac.min_inliers)) + " needed");
    return result;
  }
  if (prior) {
    // A wide kernel first, so that points are not rejected for the prior's error of some pixels.
    std::vector<int> all(n);
    std::iota(all.begin(), all.end(), 0);
    const SE3 T = refine_pose_3d2d(camera, points_ref, px, all, *prior, options.threshold_px, 8);
    std::vector<int> inliers = inliers_of(camera, T, points_ref, px, options.threshold_px);
    if (static_cast<double>(inliers.size()) >= options.prior_inlier_ratio * n)
      return finish(camera, points_ref, px, options, T, std::move(inliers));
  }

  const auto consensus = search_pose(camera, points_ref, px, options, random);
  if (!consensus.outcome) {
    Pose3d2dResult result;
    result.outcome = consensus.outcome;
    result.inliers = consensus.inliers;
    return result;
  }
  return finish(camera, points_ref, px, options, consensus.model, consensus.inliers);
}

}  // namespace placegraph
