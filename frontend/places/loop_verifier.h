#pragma once
#include <placegraph/frontend/features/matcher.h>
#include <placegraph/frontend/odometry/pose_3d2d.h>
#include <placegraph/graph/core/sim3.h>

namespace placegraph {

struct LoopVerifierOptions {
  MatcherOptions matcher{.max_distance = 60, .max_ratio = 0.85};
  Pose3d2dOptions pose{.ransac = {.max_iterations = 400, .confidence = 0.9999, .min_inliers = 40},
                       .threshold_px = 3.0,
                       .prior_inlier_ratio = 1.01};
  double min_inlier_ratio = 0.35;  ///< of the matches that agree with the pose
  double min_spread = 0.03;        ///< share of the image the inliers' box of deviations covers
  double max_scale_error = 0.15;   ///< disagreement of depths seen from both sides
  /// Views that differ more are no revisit: what little calibration and depth are off grows with
  /// it.
  double max_baseline_depths = 0.15;  ///< translation over the median depth of the inliers
  double max_angle_deg = 40;
  void check() const;
};
void visit(OptionVisitor& field, LoopVerifierOptions& options);

struct LoopVerification {
  Outcome outcome;
  SE3 T_match_query;             ///< in the match's unit; meaningful only if outcome
  double scale_match_query = 1;  ///< length at the match of one unit of length of the query
  /// Of S_match_query in its right tangent; where the scale is not asked for, the upper left 6x6
  /// block is that of T_match_query and the rest is zero.
  Matrix7d information = Matrix7d::Zero();
  int matches = 0, inliers = 0;
  double rmse_px = 0;
};

/// Whether two views show one place, and from where: descriptor matches between the query's pixels
/// and the match's points of known depth, pose by estimate_pose_3d2d, a second guided matching
/// around the projections, then tests of the inliers' number, share and spread, and of the query's
/// own depths against the match's (scale), and of the change of view. With `free_scale` the two
/// views have units of length of their own, and the depths seen from both sides tell their ratio:
/// it is estimated with the pose instead of tested, and without depths of the query there is no
/// answer. Outcomes: too few data, no consensus, inconsistent, degenerate.
[[nodiscard]] LoopVerification verify_loop(const Camera& camera, const std::vector<Feature>& query,
                                           const std::vector<Feature>& match,
                                           const LoopVerifierOptions& options, Random& random,
                                           bool free_scale = false);

}  // namespace placegraph
