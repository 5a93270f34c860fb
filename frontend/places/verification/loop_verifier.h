#pragma once
#include <placegraph/frontend/features/matcher.h>
#include <placegraph/frontend/lines/line_feature.h>
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/frontend/places/verification/loop_two_view.h>
#include <placegraph/frontend/relative_pose/pose_3d2d.h>
#include <placegraph/graph/geometry/sim3.h>
#include <placegraph/graph/loop_stage.h>

#include <span>

namespace placegraph {

/// Maximum |log| of the median ratio of the depths that are known in both keyframes. Chosen.
constexpr double kMaxLoopScaleError = 0.15;
/// Maximum translation between the keyframes over the median depth of the inliers; errors of
/// calibration and depth grow with this ratio. Chosen.
constexpr double kMaxLoopBaseline_depths = 0.15;

/// Features by which a view is verified. Refers to lists of its owner.
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
  SE3 T_match_query;             ///< pose in the match's scale; meaningful only if outcome
  double scale_match_query = 1;  ///< factor from lengths of the query to lengths of the match
  /// Information of S_match_query in its right tangent; if the scale is not estimated, the upper
  /// left 6x6 block is that of T_match_query and the rest is zero.
  Matrix7d information = Matrix7d::Zero();
  int matches = 0, inliers = 0;  ///< points
  int lines = 0;                 ///< number of lines that agree with the pose
  double rmse_px = 0;
};

/// Verifies that two views show the same place and estimates their relative pose.
///
/// Descriptor matches connect the query's pixels with the match's points of known depth;
/// estimate_pose_3d2d computes the pose and a second, guided matching around the projections
/// follows. If too few points have a depth, loop_of_two_views is used. Lines of the match count
/// beside the points if they are in the query where the pose predicts them. Tests follow: number,
/// share and spread of the inliers, the query's own depths against the match's (scale), and the
/// change of view. With `free_scale` each view has its own scale, and the depths from both sides
/// determine the ratio: it is estimated with the pose instead of tested, and there is no result
/// without depths of the query. Outcomes: too few data, no consensus, inconsistent, degenerate.
[[nodiscard]] LoopVerification verify_loop(const Camera& camera, const LoopView& query,
                                           const LoopView& match,
                                           const LoopVerifierOptions& options, Random& random,
                                           bool free_scale = false);

}  // namespace placegraph
