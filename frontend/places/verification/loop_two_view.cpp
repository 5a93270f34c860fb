#include <placegraph/frontend/places/verification/loop_two_view.h>
#include <placegraph/frontend/relative_pose/epipolar_error.h>
#include <placegraph/graph/core/median.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Minimum median displacement beyond that of the rotation. Chosen.
constexpr double kMinLoopParallax_px = 4;
/// Maximum |log ratio| between an agreeing depth and the median. Chosen.
constexpr double kMaxDepthSpread = 0.2;

using Code = Outcome::Code;
using Eigen::Vector3d;

struct Rays {
  std::vector<Vector3d> match, query;
};

/// log(known depth / depth for a baseline of 1), of the depths of one view.
struct LengthEvidence {
  std::vector<double> log_ratios;
  double median = 0;
  int agreeing = 0;

  void settle(double max_spread) {
    if (log_ratios.empty()) return;
    median = median_of(log_ratios);
    agreeing =
        static_cast<int>(std::count_if(log_ratios.begin(), log_ratios.end(), [&](double value) {
          return std::abs(value - median) < max_spread;
        }));
  }
  bool enough() const {
    return agreeing >= kMinDepths &&
           agreeing >= kMinDepthShare * static_cast<double>(log_ratios.size());
  }
};

/// Motion with a baseline of 1 that two views allow, and its support.
struct Candidate {
  SE3 T_match_query;
  int ahead = 0;  ///< number of points in front of both cameras
  double parallax_px = 0;
  LengthEvidence match = {}, query = {};  ///< evidence of the depths in either view

  int agreeing() const { return match.agreeing + query.agreeing; }
};

Candidate judged(const Camera& camera, const SE3& T_match_query, const Rays& rays,
                 const std::vector<LoopPoint>& points, const std::vector<int>& inliers) {
  Candidate candidate{T_match_query};
  const TwoViewParallax parallax =
      two_view_parallax(camera, T_match_query, rays.match, rays.query, inliers);
  candidate.ahead = parallax.ahead;
  candidate.parallax_px = parallax.median_px;
  for (const int i : inliers) {
    const auto at = static_cast<std::size_t>(i);
    if (!points[at].point_match && !points[at].point_query) continue;
    // depth_match a = t + depth_query b, by least squares
    const Vector3d &a = rays.match[at], b = T_match_query.rotation() * rays.query[at],
                   t = T_match_query.translation();
    Eigen::Matrix2d M;
    M << a.dot(a), -a.dot(b), -a.dot(b), b.dot(b);
    const double sine2 = M.determinant() / (a.squaredNorm() * b.squaredNorm());
    const double least_rad = kMinLoopParallax_px / camera.fx;
    if (sine2 < least_rad * least_rad) continue;
    const Eigen::Vector2d depths = M.inverse() * Eigen::Vector2d(a.dot(t), -b.dot(t));
    if (depths.minCoeff() <= 0) continue;
    if (points[at].point_match && points[at].point_match->z() > 0)
      candidate.match.log_ratios.push_back(std::log(points[at].point_match->z() / depths[0]));
    if (points[at].point_query && points[at].point_query->z() > 0)
      candidate.query.log_ratios.push_back(std::log(points[at].point_query->z() / depths[1]));
  }
  candidate.match.settle(kMaxDepthSpread);
  candidate.query.settle(kMaxDepthSpread);
  return candidate;
}

/// Compares by the depths first, then by the points in front of both cameras.
bool better(const Candidate& a, const Candidate& b) {
  return std::pair(a.agreeing(), a.ahead) > std::pair(b.agreeing(), b.ahead);
}

/// Whether b has nearly as much support as a.
bool rivals(const Candidate& a, const Candidate& b) {
  // As the ambiguity of the monocular initialization. Chosen.
  constexpr double kShare = 0.8;
  return b.agreeing() >= kShare * a.agreeing() && b.ahead >= kShare * a.ahead;
}

/// Motion with its baseline in the match's scale, and the ratio of both scales.
std::optional<Sim3> with_length(const Candidate& candidate, bool free_scale) {
  const LengthEvidence &match = candidate.match, &query = candidate.query;
  const bool by_match = match.enough(), by_query = query.enough();
  if (free_scale ? !(by_match && by_query) : !(by_match || by_query)) return std::nullopt;
  double log_length = by_match ? match.median : query.median;
  if (!free_scale && by_match && by_query) {
    if (std::abs(match.median - query.median) > kMaxDepthSpread) return std::nullopt;
    log_length = (match.agreeing * match.median + query.agreeing * query.median) /
                 (match.agreeing + query.agreeing);
  }
  const double scale = free_scale ? std::exp(match.median - query.median) : 1;
  return Sim3(candidate.T_match_query.rotation(),
              std::exp(log_length) * candidate.T_match_query.translation(), scale);
}

}  // namespace

LoopOfTwoViews loop_of_two_views(const Camera& camera, const std::vector<LoopPoint>& points,
                                 const LoopTwoViewOptions& options, Random& random,
                                 bool free_scale) {
  LoopOfTwoViews result;
  std::vector<Eigen::Vector2d> px_match, px_query;
  for (const LoopPoint& point : points) {
    px_match.push_back(point.px_match);
    px_query.push_back(point.px_query);
  }
  if (estimate_rotation_2d2d(camera, px_match, px_query, options.rotation, random).outcome) {
    result.outcome = Outcome::failure(Code::kDegenerate, "the views differ by a rotation alone");
    return result;
  }
  const Pose2d2dResult pose = estimate_pose_2d2d(camera, px_match, px_query, options.pose, random);
  result.model = pose.model;
  result.inliers = pose.inliers;
  if (!pose.outcome) {
    result.outcome = pose.outcome;
    return result;
  }
  const Rays rays{rays_of(camera, px_match), rays_of(camera, px_query)};
  std::vector<Candidate> candidates;
  for (const SE3& T_match_query : pose.T_ref_cur)
    candidates.push_back(judged(camera, T_match_query, rays, points, pose.inliers));
  std::stable_sort(candidates.begin(), candidates.end(), better);
  const Candidate& best = candidates.front();
  if (best.parallax_px < kMinLoopParallax_px) {
    result.outcome = Outcome::failure(Code::kDegenerate, "too little parallax");
  } else if (candidates.size() > 1 && rivals(best, candidates[1])) {
    result.outcome =
        Outcome::failure(Code::kDegenerate, "two motions explain the views equally well");
  } else if (const auto S_match_query = with_length(best, free_scale)) {
    result.S_match_query = *S_match_query;
    result.outcome = Outcome::ok();
  } else {
    result.outcome =
        best.agreeing() < kMinDepths
            ? Outcome::failure(Code::kTooFewData, "too few depths for the baseline")
            : Outcome::failure(Code::kInconsistent, "the depths disagree on the baseline");
  }
  return result;
}

}  // namespace placegraph
