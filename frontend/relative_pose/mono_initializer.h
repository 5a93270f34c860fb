#pragma once
#include <placegraph/frontend/relative_pose/pose_2d2d.h>
#include <placegraph/frontend/relative_pose/relative_pose_options.h>

#include <optional>
#include <utility>
#include <vector>

namespace placegraph {

/// Pixels of some of the points in a view between the two: (index of the point, pixel).
using PartialView = std::vector<std::pair<int, Eigen::Vector2d>>;

/// Motion and points of a monocular initialization.
struct MonoInitialization {
  Outcome outcome;
  SE3 T_ref_cur;                                           ///< |t| = 1
  std::vector<std::optional<Eigen::Vector3d>> points_ref;  ///< one per match
  TwoViewModel model = TwoViewModel::kEssential;
  int triangulated = 0, candidates = 0;
  double median_parallax_deg = 0;
};

/// Estimates motion and structure from two views, up to scale.
///
/// estimate_pose_2d2d, then every candidate motion is scored by the number of points that it
/// triangulates in front of both cameras. If two motions explain the views equally well (a plane
/// has two solutions), the views in between decide by the reprojection error of their poses;
/// without a clear difference the result is ambiguous. Outcomes: too few data, no consensus,
/// degenerate (too little parallax), inconsistent (ambiguous).
[[nodiscard]] MonoInitialization initialize_mono(const Camera& camera,
                                                 const std::vector<Eigen::Vector2d>& px_ref,
                                                 const std::vector<Eigen::Vector2d>& px_cur,
                                                 const std::vector<PartialView>& between,
                                                 const MonoInitializerOptions& options,
                                                 Random& random);

}  // namespace placegraph
