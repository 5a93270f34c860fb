#pragma once
#include <placegraph/frontend/features/matcher.h>
#include <placegraph/frontend/lines/line_feature.h>
#include <placegraph/frontend/places/verification/loop_two_view.h>
#include <placegraph/frontend/relative_pose/pose_3d2d.h>
#include <placegraph/graph/geometry/sim3.h>
#include <placegraph/graph/loop_model.h>

#include <span>

namespace placegraph {

struct LoopVerifierOptions {
  MatcherOptions matcher{.max_distance = 60, .max_ratio = 0.85};
  Pose3d2dOptions pose{.ransac = {.max_iterations = 400, .confidence = 0.9999, .min_inliers = 40},
                       .threshold_px = 3.0,
                       .prior_inlier_ratio = 1.01};
  LoopTwoViewOptions two_view;  ///< where too few points have a depth for `pose`
  LineFeatureMatcherOptions lines;
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

/// What a view is verified by. Refers to lists of others.
struct LoopView {
  // NOLINTNEXTLINE(google-explicit-constructor): points alone are a view
  LoopView(const std::vector<Feature>& point_features,
           std::span<const LineFeature> line_features = {})
      : points(point_features), lines(line_features) {}
  const std::vector<Feature>& points;
  std::span<const LineFeature> lines;
};

struct LoopVerification {
  Outcome outcome;
  LoopModel model = LoopModel::kNone;
  SE3 T_match_query;             ///< in the match's unit; meaningful only if outcome
  double scale_match_query = 1;  ///< length at the match of one unit of length of the query
  /// Of S_match_query in its right tangent; where the scale is not asked for, the upper left 6x6
  /// block is that of T_match_query and the rest is zero.
  Matrix7d information = Matrix7d::Zero();
  int matches = 0, inliers = 0;  ///< points
  int lines = 0;                 ///< that agree with the pose
  double rmse_px = 0;
};

/// Whether two views show one place, and from where: descriptor matches between the query's pixels
/// and the match's points of known depth, pose by estimate_pose_3d2d, a second guided matching
/// around the projections; by loop_of_two_views where too few points have a depth. Lines of the
/// match that the query sees where the pose expects them count beside the points. Then tests of the
/// inliers' number, share and spread, and of the query's own depths against the match's (scale),
/// and of the change of view. With `free_scale` the two views have units of length of their own,
/// and the depths seen from both sides tell their ratio: it is estimated with the pose instead of
/// tested, and without depths of the query there is no answer. Outcomes: too few data, no
/// consensus, inconsistent, degenerate.
[[nodiscard]] LoopVerification verify_loop(const Camera& camera, const LoopView& query,
                                           const LoopView& match,
                                           const LoopVerifierOptions& options, Random& random,
                                           bool free_scale = false);

}  // namespace placegraph
