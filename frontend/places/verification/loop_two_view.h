#pragma once
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/frontend/places/verification/loop_refinement.h>
#include <placegraph/frontend/relative_pose/pose_2d2d.h>
#include <placegraph/frontend/relative_pose/rotation_2d2d.h>

namespace placegraph {

/// Minimum number of known depths that agree on the baseline. Chosen.
inline constexpr int kMinDepths = 8;
/// Minimum share of the known depths that agree. Chosen.
inline constexpr double kMinDepthShare = 0.6;

struct LoopOfTwoViews {
  Outcome outcome;
  TwoViewModel model = TwoViewModel::kEssential;
  Sim3 S_match_query;        ///< scale 1 if both views have the same scale
  std::vector<int> inliers;  ///< indices of the points, ascending
};

/// Pose of the query in the match's frame and scale, for too few depths for estimate_pose_3d2d.
///
/// The model is an essential matrix or a homography, whichever explains the matches better. The few
/// depths that are known in either view select one of the motions that it allows, and its baseline.
/// With `free_scale` depths of both views are needed, as each view has its own scale. Outcomes: too
/// few data, no consensus, degenerate (the views differ by a rotation alone, the parallax is too
/// small, two motions explain them equally well), inconsistent (the depths do not agree on a
/// baseline).
[[nodiscard]] LoopOfTwoViews loop_of_two_views(const Camera& camera,
                                               const std::vector<LoopPoint>& points,
                                               const LoopTwoViewOptions& options, Random& random,
                                               bool free_scale);

}  // namespace placegraph
