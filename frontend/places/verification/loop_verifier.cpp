#include <placegraph/frontend/lines/line_triangulation.h>
#include <placegraph/frontend/places/verification/loop_verifier.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/median.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Minimum share of the image that the inliers cover. Chosen.
constexpr double kMinSpread = 0.03;

/// Matches the query's features near the projections of the match's points.
std::vector<FeatureMatch> match_guided(const Camera& camera, const std::vector<Feature>& query,
                                       const std::vector<Feature>& match, const SE3& T_query_match,
                                       double radius_px, const MatcherOptions& options) {
  std::vector<FeatureMatch> matches;
  std::vector<int> owner(query.size(), -1);
  for (int j = 0; j < static_cast<int>(match.size()); ++j) {
    if (!match[j].point_cam) continue;
    const auto px = camera.project(T_query_match * match[j].point_cam->cast<double>());
    if (!px || !camera.contains(*px)) continue;
    FeatureMatch best{-1, j, options.max_distance + 1};
    for (int i = 0; i < static_cast<int>(query.size()); ++i) {
      if ((query[i].px.cast<double>() - *px).squaredNorm() > radius_px * radius_px) continue;
      const int distance = hamming_distance(query[i].descriptor, match[j].descriptor);
      if (distance < best.distance) best = {i, j, distance};
    }
    if (best.a < 0) continue;
    int& owned = owner[best.a];
    if (owned >= 0 && matches[owned].distance <= best.distance) continue;
    if (owned >= 0) {
      matches[owned] = best;
    } else {
      owned = static_cast<int>(matches.size());
      matches.push_back(best);
    }
  }
  return matches;
}

/// Share of the image covered by the box of +- 2 standard deviations of the query's pixels.
double spread_of(const Camera& camera, const std::vector<LoopPoint>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero(), square = Eigen::Vector2d::Zero();
  const auto count = static_cast<double>(points.size());
  for (const LoopPoint& point : points) mean += point.px_query / count;
  for (const LoopPoint& point : points) square += (point.px_query - mean).cwiseAbs2() / count;
  const Eigen::Vector2d side = 4 * square.cwiseSqrt();
  return side.x() * side.y() / (static_cast<double>(camera.width) * camera.height);
}

/// Relative pose from the points of two views, before lines are used.
struct PointsAgree {
  Outcome outcome;
  LoopModel model = LoopModel::kNone;
  Sim3 S_match_query;
  std::vector<LoopPoint> points;  // inliers
  int matches = 0;
};

std::vector<LoopPoint> points_of(const std::vector<Feature>& query,
                                 const std::vector<Feature>& match,
                                 const std::vector<FeatureMatch>& matches) {
  const auto known = [](const Feature& feature) {
    return feature.point_cam ? std::optional<Eigen::Vector3d>(feature.point_cam->cast<double>())
                             : std::nullopt;
  };
  std::vector<LoopPoint> points;
  for (const FeatureMatch& m : matches)
    points.push_back({match[m.b].px.cast<double>(), query[m.a].px.cast<double>(), known(match[m.b]),
                      known(query[m.a])});
  return points;
}

std::vector<LoopPoint> chosen(const std::vector<LoopPoint>& points,
                              const std::vector<int>& indices) {
  std::vector<LoopPoint> result;
  for (const int i : indices) result.push_back(points[static_cast<std::size_t>(i)]);
  return result;
}

Pose3d2dResult pose_of(const Camera& camera, const std::vector<LoopPoint>& points,
                       const Pose3d2dOptions& options, Random& random, const SE3* prior) {
  std::vector<Eigen::Vector3d> points_match;
  std::vector<Eigen::Vector2d> px;
  for (const LoopPoint& point : points) {
    points_match.push_back(*point.point_match);
    px.push_back(point.px_query);
  }
  return estimate_pose_3d2d(camera, points_match, px, options, random, prior);
}

/// Pose from the match's points of known depth. `few` points are enough if lines are to supply the
/// rest.
PointsAgree agree_in_space(const Camera& camera, const LoopView& query, const LoopView& match,
                           const LoopVerifierOptions& options, Random& random, int few) {
  PointsAgree result;
  result.model = LoopModel::kPoints3d2d;
  std::vector<bool> has_depth(match.points.size());
  for (std::size_t j = 0; j < match.points.size(); ++j)
    has_depth[j] = match.points[j].point_cam.has_value();
  std::vector<LoopPoint> points =
      points_of(query.points, match.points,
                match_features(query.points, match.points, options.matcher, has_depth));
  // The first pose may have fewer matches; the guided matching must supply the rest.
  Pose3d2dOptions first = options.pose;
  first.ransac.min_inliers = std::max(8, options.pose.ransac.min_inliers / 2);
  Pose3d2dResult pose = pose_of(camera, points, first, random, nullptr);
  if (pose.outcome) {
    points = points_of(query.points, match.points,
                       match_guided(camera, query.points, match.points, pose.T_ref_cam.inverse(),
                                    3 * options.pose.threshold_px, options.matcher));
    Pose3d2dOptions second = options.pose;
    second.ransac.min_inliers = few;
    second.prior_inlier_ratio = options.min_inlier_ratio;
    const SE3 prior = pose.T_ref_cam;
    pose = pose_of(camera, points, second, random, &prior);
  }
  result.outcome = pose.outcome;
  result.matches = static_cast<int>(points.size());
  result.points = chosen(points, pose.inliers);
  result.S_match_query = Sim3(pose.T_ref_cam);
  return result;
}

/// Pose from two images, with the baseline from the known depths, for views in which most matches
/// have no depth. `with_depth` matches have one.
PointsAgree agree_in_images(const Camera& camera, const LoopView& query, const LoopView& match,
                            int with_depth, const LoopVerifierOptions& options, Random& random,
                            bool free_scale) {
  PointsAgree result;
  const std::vector<LoopPoint> points = points_of(
      query.points, match.points, match_features(query.points, match.points, options.matcher));
  const int matches = static_cast<int>(points.size());
  if (matches < options.two_view.pose.ransac.min_inliers || 2 * with_depth > matches) {
    result.outcome = Outcome::failure(Outcome::Code::kTooFewData, "too few matches without depth");
    return result;
  }
  const LoopOfTwoViews views =
      loop_of_two_views(camera, points, options.two_view, random, free_scale);
  result.outcome = views.outcome;
  result.model =
      views.model == TwoViewModel::kEssential ? LoopModel::kEssential : LoopModel::kHomography;
  result.matches = matches;
  result.points = chosen(points, views.inliers);
  result.S_match_query = views.S_match_query;
  return result;
}

/// Lines of the match that are in the query where the pose predicts them.
std::vector<LoopLine> agreeing_lines(const Camera& camera, const LoopView& query,
                                     const LoopView& match, const SE3& T_match_query,
                                     const LoopVerifierOptions& options) {
  std::vector<LoopLine> lines;
  const std::vector<LineFeature> seen(query.lines.begin(), query.lines.end()),
      known(match.lines.begin(), match.lines.end());
  for (const LineFeatureMatch& m : match_lines_guided(camera, seen, known, T_match_query)) {
    const LoopLine line{*known[static_cast<std::size_t>(m.b)].line_cam,
                        seen[static_cast<std::size_t>(m.a)].segment};
    const auto r = line_residual_px(camera, T_match_query, line.line_match,
                                    line.seen_by_query.start, line.seen_by_query.end);
    if (r && r->cwiseAbs().maxCoeff() <= options.pose.threshold_px) lines.push_back(line);
  }
  return lines;
}

/// Whether the few depths that determined the baseline agree with the pose.
bool depths_fit(const Camera& camera, const PointsAgree& agree, const LoopVerification& verified,
                const LoopVerifierOptions& options) {
  const Sim3 S_match_query(verified.T_match_query.rotation(), verified.T_match_query.translation(),
                           verified.scale_match_query);
  const Sim3 S_query_match = S_match_query.inverse();
  int known = 0, fitting = 0;
  const auto ask = [&](const Eigen::Vector3d& point_cam, const Eigen::Vector2d& px) {
    const auto projected = camera.project(point_cam);
    ++known;
    fitting += projected && (*projected - px).norm() < options.pose.threshold_px;
  };
  for (const LoopPoint& point : agree.points) {
    if (point.point_match) ask(S_query_match * *point.point_match, point.px_query);
    if (point.point_query) ask(S_match_query * *point.point_query, point.px_match);
  }
  return fitting >= kMinDepths && fitting >= kMinDepthShare * known;
}

/// Reason why views with an agreeing pose are not accepted as a loop; ok if they are.
Outcome judged(const Camera& camera, const PointsAgree& agree, const LoopVerification& verified,
               const std::optional<double>& log_ratio, const LoopVerifierOptions& options,
               bool free_scale) {
  using Code = Outcome::Code;
  if (verified.inliers < options.min_inlier_ratio * verified.matches)
    return Outcome::failure(Code::kNoConsensus, "too small a share of inliers");
  if (spread_of(camera, agree.points) < kMinSpread)
    return Outcome::failure(Code::kDegenerate, "inliers crowd in one part of the image");
  std::vector<double> depths;
  const SE3 T_match_query = verified.T_match_query;
  for (const LoopPoint& point : agree.points) {
    if (point.point_match)
      depths.push_back(point.point_match->z());
    else if (point.point_query)
      depths.push_back((T_match_query * (verified.scale_match_query * *point.point_query)).z());
  }
  if (depths.empty() ||
      T_match_query.translation().norm() > kMaxLoopBaseline_depths * median_of(depths) ||
      T_match_query.rotation().log().norm() > deg_to_rad(options.max_angle_deg))
    return Outcome::failure(Code::kInconsistent, "the views differ too much");
  if (agree.model != LoopModel::kPoints3d2d && !depths_fit(camera, agree, verified, options))
    return Outcome::failure(Code::kInconsistent, "the depths do not agree with the pose");
  if (!free_scale && log_ratio && std::abs(*log_ratio) > kMaxLoopScaleError)
    return Outcome::failure(Code::kInconsistent, "the depths of both views disagree");
  return Outcome::ok();
}

}  // namespace

LoopVerification verify_loop(const Camera& camera, const LoopView& query, const LoopView& match,
                             const LoopVerifierOptions& options, Random& random, bool free_scale) {
  using Code = Outcome::Code;
  LoopVerification result;
  const bool have_lines = !query.lines.empty() && !match.lines.empty();
  const int enough = options.pose.ransac.min_inliers, few = have_lines ? enough / 2 : enough;
  PointsAgree agree = agree_in_space(camera, query, match, options, random, few);
  if (!agree.outcome && agree.matches < enough) {
    PointsAgree by_images =
        agree_in_images(camera, query, match, agree.matches, options, random, free_scale);
    if (by_images.outcome) agree = std::move(by_images);
  }
  result.model = agree.model;
  result.matches = agree.matches;
  result.inliers = static_cast<int>(agree.points.size());
  result.outcome = agree.outcome;
  if (!agree.outcome) return result;

  LoopEvidence evidence{agree.points, {}};
  SE3 T_match_query(agree.S_match_query.rotation(), agree.S_match_query.translation());
  if (have_lines) evidence.lines = agreeing_lines(camera, query, match, T_match_query, options);
  result.lines = static_cast<int>(evidence.lines.size());
  if (result.inliers + result.lines < enough) {
    result.outcome = Outcome::failure(Code::kNoConsensus, "too few points and lines agree");
    return result;
  }
  Sim3 start = agree.S_match_query;
  std::optional<double> log_ratio;
  if (agree.model == LoopModel::kPoints3d2d) {
    log_ratio = median_log_ratio(agree.points, T_match_query.inverse());
    if (free_scale && !log_ratio) {
      result.outcome = Outcome::failure(Code::kTooFewData, "too few depths for the scale");
      return result;
    }
    start = Sim3(start.rotation(), start.translation(), free_scale ? std::exp(-*log_ratio) : 1);
  }
  const LoopRefinement refined =
      refine_loop(camera, evidence, start, options.pose.threshold_px / 2, free_scale);
  const double sigma_px = std::max(0.3, refined.rmse_px);
  const Sim3& S_match_query = refined.S_match_query;
  result.T_match_query = SE3(S_match_query.rotation(), S_match_query.translation());
  result.scale_match_query = S_match_query.scale();
  result.information = refined.normal / (sigma_px * sigma_px);
  result.rmse_px = refined.rmse_px;
  result.outcome = judged(camera, agree, result, log_ratio, options, free_scale);
  return result;
}

}  // namespace placegraph
