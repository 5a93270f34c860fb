#pragma once
#include <placegraph/frontend/features/matcher.h>
#include <placegraph/frontend/odometry/pose_3d2d.h>

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
  SE3 T_match_query;                        ///< meaningful only if outcome
  Matrix6d information = Matrix6d::Zero();  ///< right tangent of T_match_query
  int matches = 0, inliers = 0;
  double rmse_px = 0;
};

/// Whether two views show one place, and from where: descriptor matches between the query's pixels
/// and the match's points of known depth, pose by estimate_pose_3d2d, a second guided matching
/// around the projections, then tests of the inliers' number, share and spread, and of the query's
/// own depths against the match's (scale), and of the change of view. Outcomes: too few data, no
/// consensus, inconsistent, degenerate.
[[nodiscard]] LoopVerification verify_loop(const Camera& camera, const std::vector<Feature>& query,
                                           const std::vector<Feature>& match,
                                           const LoopVerifierOptions& options, Random& random);

}  // namespace placegraph
