#include <placegraph/frontend/places/loop_verifier.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Matches of the query's features near the projections of the match's points.
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

/// Share of the image covered by the box of +- 2 standard deviations of the pixels.
double spread_of(const Camera& camera, const std::vector<Eigen::Vector2d>& px,
                 const std::vector<int>& indices) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero(), square = Eigen::Vector2d::Zero();
  for (int i : indices) mean += px[i] / indices.size();
  for (int i : indices) square += (px[i] - mean).cwiseAbs2() / indices.size();
  const Eigen::Vector2d side = 4 * square.cwiseSqrt();
  return side.x() * side.y() / (static_cast<double>(camera.width) * camera.height);
}

/// A match whose point is known from both sides, where the query has a depth of its own.
struct TwoWayMatch {
  Eigen::Vector3d point_match;
  Eigen::Vector2d px_query;
  std::optional<Eigen::Vector3d> point_query;
  Eigen::Vector2d px_match;
};

struct TwoWayPose {
  Sim3 S_match_query;
  Matrix7d normal = Matrix7d::Zero();  // J^T W J [1/px^2]
  double rmse_px = 0;
};

/// Gauss-Newton on the reprojection errors in both views, Huber-weighted; with the scale between
/// the views' units or without. An error common to all depths (a depth camera's, or of a short
/// baseline) pulls the pose one way from one side and the other way from the other.
TwoWayPose refine_two_way(const Camera& camera, const std::vector<TwoWayMatch>& matches,
                          const Sim3& start, double huber_px, bool free_scale) {
  TwoWayPose pose{start};
  const Eigen::Index dof = free_scale ? 7 : 6;
  for (int iteration = 0; iteration < 10; ++iteration) {
    const Sim3 S_query_match = pose.S_match_query.inverse();
    const Eigen::Matrix3d sR_match_query =
        pose.S_match_query.scale() * pose.S_match_query.rotation().matrix();
    Matrix7d H = Matrix7d::Zero();
    Vector7d g = Vector7d::Zero();
    double sum = 0, weights = 0;
    const auto add = [&](const Eigen::Vector3d& point_cam, const Eigen::Vector2d& px,
                         const Eigen::Matrix<double, 3, 7>& J_cam_xi) {
      Eigen::Matrix<double, 2, 3> J_px_cam;
      const auto projected = camera.project(point_cam, &J_px_cam);
      if (!projected) return;
      const Eigen::Matrix<double, 2, 7> J = J_px_cam * J_cam_xi;
      const Eigen::Vector2d r = *projected - px;
      const double weight = r.norm() > huber_px ? huber_px / r.norm() : 1;
      H.noalias() += weight * J.transpose() * J;
      g.noalias() += weight * J.transpose() * r;
      sum += weight * r.squaredNorm();
      weights += 2 * weight;
    };
    for (const TwoWayMatch& m : matches) {
      Eigen::Matrix<double, 3, 7> J;
      const Eigen::Vector3d p_query = S_query_match * m.point_match;
      J << -Eigen::Matrix3d::Identity(), hat(p_query), -p_query;
      add(p_query, m.px_query, J);
      if (!m.point_query) continue;
      J << sR_match_query, -sR_match_query * hat(*m.point_query), sR_match_query * *m.point_query;
      add(pose.S_match_query * *m.point_query, m.px_match, J);
    }
    pose.normal.setZero();
    pose.normal.topLeftCorner(dof, dof) = H.topLeftCorner(dof, dof);
    pose.rmse_px = weights > 0 ? std::sqrt(sum / weights) : 0;
    Eigen::MatrixXd damped = H.topLeftCorner(dof, dof);
    damped.diagonal().array() += 1e-9 * damped.trace();
    Vector7d step = Vector7d::Zero();
    step.head(dof) = -damped.ldlt().solve(g.head(dof));
    if (!step.allFinite()) break;
    pose.S_match_query = pose.S_match_query.plus(step);
    if (step.norm() < 1e-8) break;
  }
  return pose;
}

/// Median of log(depth the query measured / depth that the match's points have in it).
std::optional<double> median_log_ratio(const std::vector<TwoWayMatch>& matches,
                                       const SE3& T_query_match) {
  std::vector<double> log_ratios;
  for (const TwoWayMatch& m : matches) {
    if (!m.point_query) continue;
    const double z = (T_query_match * m.point_match).z();
    if (z > 0 && m.point_query->z() > 0) log_ratios.push_back(std::log(m.point_query->z() / z));
  }
  if (log_ratios.size() < 8) return std::nullopt;
  const auto middle = log_ratios.begin() + log_ratios.size() / 2;
  std::nth_element(log_ratios.begin(), middle, log_ratios.end());
  return *middle;
}

}  // namespace

void LoopVerifierOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LoopVerifierOptions& o) {
  field.group("matcher", o.matcher, "descriptor matching");
  field.group("pose", o.pose, "relative pose from 3-D points to pixels");
  field("min_inlier_ratio", o.min_inlier_ratio, "share of the matches that must agree", {0, 1});
  field("min_spread", o.min_spread, "share of the image the inliers must cover", {0, 1});
  field("max_scale_error", o.max_scale_error, "disagreement of depths seen from both sides",
        {0, 10});
  field("max_baseline_depths", o.max_baseline_depths,
        "translation between the views over the median depth of the inliers", {0.01, 100});
  field("max_angle_deg", o.max_angle_deg, "rotation between the views", {1, 180});
}

LoopVerification verify_loop(const Camera& camera, const std::vector<Feature>& query,
                             const std::vector<Feature>& match, const LoopVerifierOptions& options,
                             Random& random, bool free_scale) {
  using Code = Outcome::Code;
  LoopVerification result;
  std::vector<bool> has_depth(match.size());
  for (std::size_t j = 0; j < match.size(); ++j) has_depth[j] = match[j].point_cam.has_value();

  std::vector<FeatureMatch> matches = match_features(query, match, options.matcher, has_depth);
  Pose3d2dResult pose;
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> px;
  for (int round = 0; round < 2; ++round) {
    points.clear();
    px.clear();
    for (const FeatureMatch& m : matches) {
      points.push_back(match[m.b].point_cam->cast<double>());
      px.push_back(query[m.a].px.cast<double>());
    }
    Pose3d2dOptions pose_options = options.pose;
    if (round == 0) {
      // A first pose may stand on fewer matches; the guided round must bring the rest.
      pose_options.ransac.min_inliers = std::max(8, options.pose.ransac.min_inliers / 2);
    } else {
      pose_options.prior_inlier_ratio = options.min_inlier_ratio;
    }
    const SE3 prior = pose.T_ref_cam;
    pose = estimate_pose_3d2d(camera, points, px, pose_options, random, round ? &prior : nullptr);
    result.matches = static_cast<int>(matches.size());
    result.inliers = static_cast<int>(pose.inliers.size());
    if (!pose.outcome) {
      result.outcome = pose.outcome;
      return result;
    }
    if (round == 0)
      matches = match_guided(camera, query, match, pose.T_ref_cam.inverse(),
                             3 * options.pose.threshold_px, options.matcher);
  }
  std::vector<TwoWayMatch> both;
  for (int i : pose.inliers) {
    const Feature& own = query[matches[i].a];
    both.push_back({points[i], px[i], std::nullopt, match[matches[i].b].px.cast<double>()});
    if (own.point_cam) both.back().point_query = own.point_cam->cast<double>();
  }
  const auto log_ratio = median_log_ratio(both, pose.T_ref_cam.inverse());
  if (free_scale && !log_ratio) {
    result.outcome = Outcome::failure(Code::kTooFewData, "too few depths for the scale");
    return result;
  }
  const Sim3 start(pose.T_ref_cam.rotation(), pose.T_ref_cam.translation(),
                   free_scale ? std::exp(-*log_ratio) : 1);
  const TwoWayPose refined =
      refine_two_way(camera, both, start, options.pose.threshold_px / 2, free_scale);
  const double sigma_px = std::max(0.3, refined.rmse_px);
  const Sim3& S_match_query = refined.S_match_query;
  result.T_match_query = SE3(S_match_query.rotation(), S_match_query.translation());
  result.scale_match_query = S_match_query.scale();
  result.information = refined.normal / (sigma_px * sigma_px);
  result.rmse_px = refined.rmse_px;

  if (result.inliers < options.min_inlier_ratio * result.matches) {
    result.outcome = Outcome::failure(Code::kNoConsensus, "too small a share of inliers");
    return result;
  }
  if (spread_of(camera, px, pose.inliers) < options.min_spread) {
    result.outcome = Outcome::failure(Code::kDegenerate, "inliers crowd in one part of the image");
    return result;
  }
  std::vector<double> depths;
  for (int i : pose.inliers) depths.push_back(points[i].z());
  std::nth_element(depths.begin(), depths.begin() + depths.size() / 2, depths.end());
  if (result.T_match_query.translation().norm() >
          options.max_baseline_depths * depths[depths.size() / 2] ||
      result.T_match_query.rotation().log().norm() > options.max_angle_deg * M_PI / 180) {
    result.outcome = Outcome::failure(Code::kInconsistent, "the views differ too much");
    return result;
  }
  if (!free_scale && log_ratio && std::abs(*log_ratio) > options.max_scale_error) {
    result.outcome = Outcome::failure(Code::kInconsistent, "depths of both views disagree");
    return result;
  }
  result.outcome = Outcome::ok();
  return result;
}

}  // namespace placegraph
