#pragma once
#include <placegraph/frontend/internal/places/verification/loop_refinement.h>
#include <placegraph/frontend/internal/relative_pose/pose_2d2d.h>
#include <placegraph/frontend/internal/relative_pose/rotation_2d2d.h>
#include <placegraph/frontend/places/recognition_options.h>

namespace placegraph {

struct LoopOfTwoViews {
  Outcome outcome;
  TwoViewModel model = TwoViewModel::kEssential;
  Sim3 S_match_query;        ///< of scale 1 where both views are in one unit
  std::vector<int> inliers;  ///< into the points; ascending
};

/// Where the query stands in the match's frame and unit when too few points have a depth for
/// estimate_pose_3d2d: essential matrix or homography, whichever explains the matches better; the
/// motion among those that it allows, and its length, by the few depths that are known in either
/// view. With `free_scale` depths of both are needed, as each view has a unit of its own. Outcomes:
/// too few data, no consensus, degenerate (the views differ by a turn alone, parallax too small,
/// two motions explain them equally well), inconsistent (the depths do not agree on a length).
[[nodiscard]] LoopOfTwoViews loop_of_two_views(const Camera& camera,
                                               const std::vector<LoopPoint>& points,
                                               const LoopTwoViewOptions& options, Random& random,
                                               bool free_scale);

}  // namespace placegraph
