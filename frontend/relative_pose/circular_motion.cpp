#include <placegraph/frontend/relative_pose/epipolar_error.h>
#include <placegraph/frontend/relative_pose/relative_pose.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace placegraph {
namespace {

using Eigen::Vector3d;

struct Views {
  const Camera& camera;
  std::vector<Vector3d> x_ref, x_cur;  // rays with z = 1
  SO3 R_level_cam;
};

SE3 camera_motion(const Views& views, double yaw_rad) {
  const SE3 T_level_cam(views.R_level_cam, Vector3d::Zero());
  const SE3 T_level(SO3::exp(yaw_rad * Vector3d::UnitY()),
                    {std::sin(yaw_rad / 2), 0, std::cos(yaw_rad / 2)});
  return T_level_cam.inverse() * T_level * T_level_cam;
}

/// Derivative of the right tangent of camera_motion with respect to the yaw.
Vector6d motion_by_yaw(const Views& views, double yaw_rad) {
  // In the levelled frame: dt = R_y(yaw) u, dR = R_y(yaw) hat(y).
  const Vector3d u = 0.5 * Vector3d(std::cos(yaw_rad / 2), 0, std::sin(yaw_rad / 2));
  Vector6d xi;
  xi << views.R_level_cam.inverse() * u, views.R_level_cam.inverse() * Vector3d::UnitY();
  return xi;
}

std::vector<double> votes_of(const Views& views) {
  std::vector<double> votes;
  for (std::size_t i = 0; i < views.x_ref.size(); ++i) {
    const Vector3d r = views.R_level_cam * views.x_ref[i], c = views.R_level_cam * views.x_cur[i];
    votes.push_back(2 * std::atan2(c.y() * r.x() - r.y() * c.x(), r.y() * c.z() + c.y() * r.z()));
    // tan has the period pi: of the two yaws, the one below pi.
    if (votes.back() > std::numbers::pi) votes.back() -= 2 * std::numbers::pi;
    if (votes.back() < -std::numbers::pi) votes.back() += 2 * std::numbers::pi;
  }
  return votes;
}

/// Centres of the bins with most votes, neighbours with half weight, at least a bin apart.
std::vector<double> fullest_bins(const std::vector<double>& votes, const CircularMotionOptions& o,
                                 std::size_t count) {
  const double bin = deg_to_rad(o.bin_deg), most = deg_to_rad(o.max_yaw_deg);
  const int half = static_cast<int>(std::ceil(most / bin));
  std::vector<double> histogram(2 * half + 1, 0), smooth(2 * half + 1, 0);
  for (const double vote : votes)
    if (std::abs(vote) <= most) ++histogram[half + static_cast<int>(std::lround(vote / bin))];
  for (int i = 0; i <= 2 * half; ++i)
    smooth[i] = histogram[i] +
                0.5 * ((i > 0 ? histogram[i - 1] : 0) + (i < 2 * half ? histogram[i + 1] : 0));
  std::vector<int> order(smooth.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return smooth[a] > smooth[b]; });
  std::vector<double> middles;
  for (const int i : order) {
    if (middles.size() == count || !(smooth[i] > 0)) break;
    const double middle = (i - half) * bin;
    if (std::none_of(middles.begin(), middles.end(),
                     [&](double other) { return std::abs(other - middle) < 1.5 * bin; }))
      middles.push_back(middle);
  }
  return middles;
}

struct Fit {
  double yaw_rad = 0;
  double score_px2 = 0;       // truncated squared errors
  double curvature = 0;       // sum of squared derivatives of the inliers [px^2/rad^2]
  double inlier_sum_px2 = 0;  // sum of squared errors
  std::vector<int> inliers;
};

/// Gauss-Newton over the yaw on the inliers.
Fit refine(const Views& views, double yaw_rad, double threshold_px) {
  Fit fit;
  // Iterations at most. Chosen.
  constexpr int kIterations = 8;
  for (int iteration = 0; iteration <= kIterations; ++iteration) {
    const EpipolarError error(views.camera, camera_motion(views, yaw_rad));
    const Vector6d by_yaw = motion_by_yaw(views, yaw_rad);
    fit = Fit{yaw_rad, 0, 0, 0, {}};
    double gradient = 0;
    for (std::size_t i = 0; i < views.x_ref.size(); ++i) {
      Eigen::Matrix<double, 1, 6> J;
      const double r = error(views.x_ref[i], views.x_cur[i], &J);
      if (!(std::abs(r) < threshold_px)) {
        fit.score_px2 += threshold_px * threshold_px;
        continue;
      }
      const double j = J * by_yaw;
      fit.score_px2 += r * r;
      fit.inlier_sum_px2 += r * r;
      fit.curvature += j * j;
      gradient += j * r;
      fit.inliers.push_back(static_cast<int>(i));
    }
    if (!(fit.curvature > 0) || iteration == kIterations) break;
    const double step = -gradient / fit.curvature;
    if (std::abs(step) < 1e-8) break;
    yaw_rad += step;
  }
  return fit;
}

}  // namespace

CircularMotionResult estimate_circular_motion(const Camera& camera,
                                              const std::vector<Eigen::Vector2d>& px_ref,
                                              const std::vector<Eigen::Vector2d>& px_cur,
                                              const SO3& R_level_cam,
                                              const CircularMotionOptions& options) {
  options.check();
  require(px_ref.size() == px_cur.size(),
          "estimate_circular_motion: as many pixels in both views needed");
  CircularMotionResult result;
  const int n = static_cast<int>(px_ref.size());
  if (n < options.min_inliers) {
    result.outcome = Outcome::failure(Outcome::Code::kTooFewData, std::to_string(n) + " points");
    return result;
  }
  const Views views{camera, rays_of(camera, px_ref), rays_of(camera, px_cur), R_level_cam};
  // Peaks of the histogram that are refined: the cost. Chosen.
  constexpr std::size_t kPeaks = 5;
  Fit best;
  best.score_px2 = options.threshold_px * options.threshold_px * n;
  for (const double yaw : fullest_bins(votes_of(views), options, kPeaks)) {
    Fit fit = refine(views, yaw, options.threshold_px);
    if (fit.score_px2 < best.score_px2) best = std::move(fit);
  }
  result.inliers = best.inliers;
  const int found = static_cast<int>(best.inliers.size());
  if (found < std::max<double>(options.min_inliers, options.min_share * n)) {
    result.outcome =
        Outcome::failure(Outcome::Code::kNoConsensus,
                         std::to_string(found) + " of " + std::to_string(n) + " points agree");
    return result;
  }
  result.yaw_rad = best.yaw_rad;
  result.rmse_px = std::sqrt(best.inlier_sum_px2 / found);
  result.sigma_yaw_rad = std::max(0.1, result.rmse_px) / std::sqrt(best.curvature);
  SE3 T = camera_motion(views, best.yaw_rad);
  const TwoViewParallax parallax =
      two_view_parallax(camera, T, views.x_ref, views.x_cur, best.inliers);
  if (parallax.behind > parallax.ahead) T = SE3(T.rotation(), -T.translation());  // backwards
  result.T_ref_cur = T;
  result.parallax_px = parallax.median_px;
  result.outcome = parallax.median_px < options.min_parallax_px
                       ? Outcome::failure(Outcome::Code::kDegenerate,
                                          "a parallax of " + std::to_string(parallax.median_px) +
                                              " px: the car is stationary")
                       : Outcome::ok();
  return result;
}

}  // namespace placegraph
