#include <placegraph/frontend/planes/motion_from_planes.h>
#include <placegraph/frontend/relative_pose/epipolar_error.h>
#include <placegraph/frontend/relative_pose/epipolar_refinement.h>
#include <placegraph/frontend/relative_pose/pose_2d2d.h>
#include <placegraph/frontend/relative_pose/relative_pose.h>
#include <placegraph/frontend/relative_pose/rotation_2d2d.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace placegraph {
namespace {

using Code = Outcome::Code;
using Model = RelativePoseModel;

struct Views {
  const Camera& camera;
  const std::vector<Eigen::Vector2d>& px_ref;
  const std::vector<Eigen::Vector2d>& px_cur;
  std::vector<Eigen::Vector3d> x_ref, x_cur;  // rays with z = 1
};

std::vector<Eigen::Vector2d> chosen(const std::vector<Eigen::Vector2d>& px,
                                    const std::vector<int>& indices) {
  std::vector<Eigen::Vector2d> result;
  for (const int i : indices) result.push_back(px[i]);
  return result;
}

/// The rotation of the matches `indices`, if one rotation explains almost all of them.
Rotation2d2dResult rotation_of(const Views& views, const std::vector<int>& indices,
                               const Rotation2d2dOptions& options, Random& random) {
  Rotation2d2dResult result = estimate_rotation_2d2d(
      views.camera, chosen(views.px_ref, indices), chosen(views.px_cur, indices), options, random);
  for (int& i : result.inliers) i = indices[i];
  return result;
}

void take_rotation(const Rotation2d2dResult& rotation, RelativePose& result) {
  result.model = Model::kRotation;
  result.outcome = rotation.outcome;
  result.inliers = rotation.inliers;
  result.rmse_px = rotation.rmse_px;
  result.parallax_px = 0;
  if (!rotation.outcome) return;
  result.R_ref_cur = rotation.R_ref_cur;
  result.covariance.bottomRightCorner<3, 3>() = rotation.covariance;
}

/// Covariance with five degrees of freedom: the translation's length is unobservable.
Matrix6d covariance_of(const Matrix6d& information) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(information);
  Matrix6d covariance = Matrix6d::Zero();
  for (int i = 1; i < 6; ++i)
    covariance += eigen.eigenvectors().col(i) * eigen.eigenvectors().col(i).transpose() /
                  std::max(eigen.eigenvalues()[i], 1e-12);
  return covariance;
}

/// The matches with a Sampson error within `threshold_px`.
std::vector<int> meeting(const Views& views, const SE3& T_ref_cur, double threshold_px) {
  const EpipolarError error(views.camera, T_ref_cur);
  std::vector<int> indices;
  for (int i = 0; i < static_cast<int>(views.x_ref.size()); ++i)
    if (std::abs(error(views.x_ref[i], views.x_cur[i])) < threshold_px) indices.push_back(i);
  return indices;
}

/// The motion with most points in front of both cameras, among the four of an essential matrix.
void take_essential(const Views& views, const Pose2d2dResult& found,
                    const RelativePoseOptions& options, RelativePose& result) {
  constexpr double kLeastSigma_px = 0.1;  // the residuals of a few points may be small by chance
  result.model = Model::kEssential;
  std::vector<std::pair<int, SE3>> ranked;
  for (const SE3& T_ref_cur : found.T_ref_cur)
    ranked.emplace_back(
        two_view_parallax(views.camera, T_ref_cur, views.x_ref, views.x_cur, found.inliers).ahead,
        T_ref_cur);
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  const double huber_px = options.two_view.threshold_px / 2;
  const auto refine = [&](const SE3& T, double sigma_px, Matrix6d* information) {
    return refine_epipolar(views.camera, views.x_ref, views.x_cur, result.inliers, T,
                           {huber_px, sigma_px, 10}, information);
  };
  // The inliers of a model from five points are biased; those of a model from all of them less so.
  SE3 T = ranked[0].second;
  // Chosen.
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    T = refine(T, 1, nullptr);
    result.inliers = meeting(views, T, options.two_view.threshold_px);
  }
  result.rmse_px = epipolar_rmse_px(views.camera, views.x_ref, views.x_cur, result.inliers, T);
  Matrix6d information = Matrix6d::Zero();
  T = refine(T, std::max(kLeastSigma_px, result.rmse_px), &information);
  result.T_ref_cur = T;
  result.R_ref_cur = T.rotation();
  result.covariance = covariance_of(information);
  const TwoViewParallax parallax =
      two_view_parallax(views.camera, T, views.x_ref, views.x_cur, result.inliers);
  result.parallax_px = parallax.median_px;
  for (const auto& [ahead, other] : ranked)
    if (ahead > options.ambiguity * ranked[0].first) result.rivals.push_back(other);
  if (parallax.median_px < options.min_parallax_px)
    result.outcome =
        Outcome::failure(Code::kDegenerate, "a parallax of " + std::to_string(parallax.median_px) +
                                                " px does not determine a translation");
  else if (result.rivals.size() > 1)
    result.outcome = Outcome::failure(Code::kInconsistent, "two motions explain the views");
  else
    result.outcome = Outcome::ok();
  if (result.rivals.size() == 1) result.rivals.clear();
}

/// The inliers of a homography as one region, with the noise estimated from them.
PlanarRegionsResult one_plane(const PointMatches& matches, const std::vector<int>& inliers,
                              HomographyFit& fit) {
  // Iterations at most, and the least noise. Chosen.
  constexpr int kIterations = 20;
  constexpr double kLeastSigma_px = 0.1;
  PlanarRegionsResult regions;
  std::array<int, 4> corners{};
  // Initialize by the four inliers that are farthest out in each diagonal direction.
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector2d out(k & 1 ? 1 : -1, k & 2 ? 1 : -1);
    corners[static_cast<std::size_t>(k)] = *std::max_element(
        inliers.begin(), inliers.end(),
        [&](int a, int b) { return out.dot(matches.px_ref[a]) < out.dot(matches.px_ref[b]); });
  }
  const auto start = homography_through(matches, corners);
  if (!start) {
    fit.outcome = Outcome::failure(Code::kDegenerate, "the matches do not span a plane");
    return regions;
  }
  regions.noise.sigma_px = 1;
  fit = refine_homography(*start, matches, inliers, regions.noise, kIterations);
  if (!fit.outcome) return regions;
  double sum = 0;
  for (const int i : inliers)
    sum += transfer_error(fit.H_cur_ref, matches.px_ref[i], matches.px_cur[i]).squared;
  regions.noise.sigma_px =
      std::max(kLeastSigma_px, std::sqrt(sum / (2 * static_cast<double>(inliers.size()))));
  fit = refine_homography(fit.H_cur_ref, matches, inliers, regions.noise, kIterations);
  if (!fit.outcome) return regions;
  regions.labels.assign(matches.px_ref.size(), 0);
  for (const int i : inliers) regions.labels[static_cast<std::size_t>(i)] = 1;
  regions.regions = {{fit.H_cur_ref, fit.covariance, static_cast<int>(inliers.size()), fit.cost}};
  regions.outcome = Outcome::ok();
  return regions;
}

void take_homography(const Views& views, const Pose2d2dResult& found,
                     const RelativePoseOptions& options, RelativePose& result) {
  result.model = Model::kHomography;
  const PointMatches matches{views.px_ref, views.px_cur};
  HomographyFit fit;
  const PlanarRegionsResult regions = one_plane(matches, found.inliers, fit);
  if (!regions.outcome) {
    result.outcome = fit.outcome;
    return;
  }
  result.rmse_px = regions.noise.sigma_px;
  const MotionFromPlanesResult motion =
      motion_from_planes(views.camera, matches, regions, options.plane);
  result.outcome = motion.outcome;
  if (motion.readings.empty()) return;
  for (const PlanesReading& reading : motion.readings)
    result.rivals.push_back(reading.T_cur_ref.inverse());
  const SE3& T_cur_ref = motion.readings.front().T_cur_ref;
  result.T_ref_cur = T_cur_ref.inverse();
  result.R_ref_cur = result.T_ref_cur->rotation();
  // (T Exp(xi))^-1 = T^-1 Exp(-Ad_T xi)
  const Matrix6d Ad = T_cur_ref.adjoint();
  const Matrix6d covariance = Ad * motion.readings.front().covariance * Ad.transpose();
  result.covariance = 0.5 * (covariance + covariance.transpose());
  result.parallax_px =
      two_view_parallax(views.camera, *result.T_ref_cur, views.x_ref, views.x_cur, found.inliers)
          .median_px;
  if (result.outcome && result.rivals.size() > 1)
    result.outcome = Outcome::failure(Code::kInconsistent, "two motions explain the plane");
  if (result.rivals.size() == 1) result.rivals.clear();
}

}  // namespace

void GravityPoseOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, GravityPoseOptions& o) {
  field.internal().group("ransac", o.ransac, "three-point hypotheses");
  field("threshold_px", o.threshold_px, "maximum Sampson error of an inlier [px]", {0.1, 20});
  field("sigma_gravity_deg", o.sigma_gravity_deg,
        "standard deviation of each view's vertical [deg]", {1e-4, 10});
  field("min_parallax_px", o.min_parallax_px, "minimum median displacement for a translation [px]",
        {0, 100});
}

void CircularMotionOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, CircularMotionOptions& o) {
  field("threshold_px", o.threshold_px, "maximum Sampson error of an inlier [px]", {0.1, 20});
  field("max_yaw_deg", o.max_yaw_deg, "maximum yaw between the views [deg]", {0.1, 120});
  field("bin_deg", o.bin_deg, "bin width of the histogram of votes [deg]", {0.001, 5});
  field("min_parallax_px", o.min_parallax_px, "minimum median displacement for an estimate [px]",
        {0, 100});
  field("min_inliers", o.min_inliers, "minimum number of inliers", {2, 1000000});
  field("min_share", o.min_share, "minimum share of inliers", {0, 1});
}

void Pose3d3dOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, Pose3d3dOptions& o) {
  field.internal().group("ransac", o.ransac, "three-point hypotheses");
  field("threshold_sigmas", o.threshold_sigmas, "maximum error of an inlier [standard deviations]",
        {0.5, 20});
}

RelativePose estimate_relative_pose(const Camera& camera,
                                    const std::vector<Eigen::Vector2d>& px_ref,
                                    const std::vector<Eigen::Vector2d>& px_cur,
                                    const RelativePoseOptions& options, Random& random) {
  options.check();
  require(px_ref.size() == px_cur.size(),
          "estimate_relative_pose: as many pixels in both views needed");
  const Views views{camera, px_ref, px_cur, rays_of(camera, px_ref), rays_of(camera, px_cur)};
  RelativePose result;
  std::vector<int> all(px_ref.size());
  std::iota(all.begin(), all.end(), 0);
  if (options.model == Model::kRotation) {
    take_rotation(rotation_of(views, all, options.rotation, random), result);
    return result;
  }
  Pose2d2dOptions two_view = options.two_view;
  if (options.model == Model::kEssential) two_view.homography_share = 1;
  if (options.model == Model::kHomography) two_view.homography_share = 0;
  const Pose2d2dResult found = estimate_pose_2d2d(camera, px_ref, px_cur, two_view, random);
  result.outcome = found.outcome;
  result.inliers = found.inliers;
  result.homography_share = found.homography_share;
  result.model = options.model;
  if (options.model == Model::kAuto && !found.inliers.empty()) {
    const Rotation2d2dResult rotation = rotation_of(views, found.inliers, options.rotation, random);
    if (rotation.outcome) {
      take_rotation(rotation, result);
      return result;
    }
  }
  if (!found.outcome) return result;
  if (options.model == Model::kHomography && found.model != TwoViewModel::kHomography) {
    result.outcome = Outcome::failure(Code::kNoConsensus, "no plane among the matches");
    return result;
  }
  if (found.model == TwoViewModel::kEssential)
    take_essential(views, found, options, result);
  else
    take_homography(views, found, options, result);
  return result;
}

}  // namespace placegraph
