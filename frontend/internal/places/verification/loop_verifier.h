#pragma once
#include <placegraph/frontend/internal/features/matcher.h>
#include <placegraph/frontend/internal/lines/line_feature.h>
#include <placegraph/frontend/internal/places/verification/loop_two_view.h>
#include <placegraph/frontend/internal/relative_pose/pose_3d2d.h>
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/geometry/sim3.h>
#include <placegraph/graph/loop_stage.h>

#include <span>

namespace placegraph {

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
