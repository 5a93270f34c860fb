#include <placegraph/frontend/features/triangulation.h>
#include <placegraph/frontend/relative_pose/mono_initializer.h>
#include <placegraph/frontend/relative_pose/pose_3d2d.h>
#include <placegraph/graph/core/angle.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace placegraph {
namespace {

// Maximum reprojection error of a triangulated point. Chosen.
constexpr double kMaxError_px = 1.5;
// A second motion that triangulates this share of the best one's points makes the result ambiguous,
// unless the images between the two resolve it. Chosen.
constexpr double kAmbiguity = 0.8;

struct Hypothesis {
  SE3 T_ref_cur;
  std::vector<std::optional<Eigen::Vector3d>> points_ref;
  std::vector<double> parallaxes_rad;
  double between_px = 0;  // error in the intermediate views
};

Hypothesis triangulate_all(const Camera& camera, const std::vector<Eigen::Vector2d>& px_ref,
                           const std::vector<Eigen::Vector2d>& px_cur,
                           const std::vector<int>& inliers, const SE3& T_ref_cur,
                           double max_error_px) {
  // Angle from which a point is triangulated. Chosen.
  constexpr double kMinParallaxRad = deg_to_rad(0.1);
  Hypothesis hypothesis{T_ref_cur, {}, {}, 0};
  hypothesis.points_ref.resize(px_ref.size());
  for (int i : inliers) {
    const auto point = triangulate(camera, {{SE3(), px_ref[i]}, {T_ref_cur, px_cur[i]}},
                                   kMinParallaxRad, max_error_px);
    if (!point.outcome) continue;
    hypothesis.points_ref[i] = point.point_ref;
    hypothesis.parallaxes_rad.push_back(point.parallax_rad);
  }
  return hypothesis;
}

/// Root mean square reprojection error of the intermediate views, each at its best pose; nothing if
/// no view has enough points.
std::optional<double> judge_between(const Camera& camera, const Hypothesis& hypothesis,
                                    const std::vector<PartialView>& between) {
  double sum = 0;
  int count = 0;
  for (std::size_t v = 0; v < between.size(); ++v) {
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector2d> px;
    for (const auto& [i, pixel] : between[v])
      if (hypothesis.points_ref[i]) {
        points.push_back(*hypothesis.points_ref[i]);
        px.push_back(pixel);
      }
    if (points.size() < 12) continue;
    std::vector<int> all(points.size());
    std::iota(all.begin(), all.end(), 0);
    // Start from an interpolated pose, at the view's share of the whole motion.
    const double share = (v + 1.0) / (between.size() + 1.0);
    const SE3 start = SE3::exp(share * hypothesis.T_ref_cur.log());
    const SE3 T_ref_view = refine_pose_3d2d(camera, points, px, all, start, 2.0, 15);
    const SE3 T_view_ref = T_ref_view.inverse();
    for (std::size_t k = 0; k < points.size(); ++k) {
      const auto projected = camera.project(T_view_ref * points[k]);
      sum += projected ? std::min(25.0, (*projected - px[k]).squaredNorm()) : 25.0;
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return std::sqrt(sum / count);
}

}  // namespace

MonoInitialization initialize_mono(const Camera& camera, const std::vector<Eigen::Vector2d>& px_ref,
                                   const std::vector<Eigen::Vector2d>& px_cur,
                                   const std::vector<PartialView>& between,
                                   const MonoInitializerOptions& options, Random& random) {
  using Code = Outcome::Code;
  MonoInitialization result;
  const Pose2d2dResult motion =
      estimate_pose_2d2d(camera, px_ref, px_cur, options.two_view, random);
  result.model = motion.model;
  result.candidates = static_cast<int>(motion.T_ref_cur.size());
  if (!motion.outcome) {
    result.outcome = motion.outcome;
    return result;
  }
  std::vector<Hypothesis> hypotheses;
  for (const SE3& T_ref_cur : motion.T_ref_cur)
    hypotheses.push_back(
        triangulate_all(camera, px_ref, px_cur, motion.inliers, T_ref_cur, kMaxError_px));
  std::stable_sort(hypotheses.begin(), hypotheses.end(), [](const auto& a, const auto& b) {
    return a.parallaxes_rad.size() > b.parallaxes_rad.size();
  });
  Hypothesis* best = &hypotheses[0];
  if (hypotheses.size() > 1 &&
      hypotheses[1].parallaxes_rad.size() > kAmbiguity * hypotheses[0].parallaxes_rad.size()) {
    const auto first = judge_between(camera, hypotheses[0], between);
    const auto second = judge_between(camera, hypotheses[1], between);
    // Ratio of the errors of two motions in views between that decides. Chosen.
    constexpr double kVerdict = 0.7;
    if (first && second && *second < kVerdict * *first) {
      best = &hypotheses[1];
    } else if (!(first && second && *first < kVerdict * *second)) {
      result.outcome = Outcome::failure(Code::kInconsistent, "two motions explain the views");
      return result;
    }
  }
  result.T_ref_cur = best->T_ref_cur;
  result.points_ref = best->points_ref;
  std::vector<double>& parallaxes = best->parallaxes_rad;
  result.triangulated = static_cast<int>(parallaxes.size());
  std::sort(parallaxes.begin(), parallaxes.end());
  if (!parallaxes.empty())
    result.median_parallax_deg = rad_to_deg(parallaxes[parallaxes.size() / 2]);
  const double limit_rad = deg_to_rad(options.min_parallax_deg);
  const auto wide =
      parallaxes.end() - std::lower_bound(parallaxes.begin(), parallaxes.end(), limit_rad);
  result.outcome = wide >= options.min_points
                       ? Outcome::ok()
                       : Outcome::failure(Code::kDegenerate,
                                          std::to_string(wide) + " points with enough parallax");
  return result;
}

}  // namespace placegraph
