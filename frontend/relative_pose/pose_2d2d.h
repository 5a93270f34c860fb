#pragma once
#include <placegraph/frontend/relative_pose/relative_pose_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/camera.h>

#include <vector>

namespace placegraph {

/// Model of the relative pose of two views.
enum class TwoViewModel { kEssential, kHomography };

/// Candidate motions between two views.
struct Pose2d2dResult {
  Outcome outcome;
  TwoViewModel model = TwoViewModel::kEssential;
  /// Candidate motions T_ref_cur with |t| = 1, all that the model allows: four for an essential
  /// matrix, up to two for a homography. The caller decides by triangulation.
  std::vector<SE3> T_ref_cur;
  std::vector<int> inliers;
  double homography_share = 0;  ///< R_H = S_H / (S_H + S_E)
};

/// Estimates the relative pose of two views up to scale.
///
/// Five-point essential matrix (Nister 2004, by OpenGV) and four-point homography, each in RANSAC;
/// the better one by the scores of ORB-SLAM (Mur-Artal et al. 2015, sec. IV). Outcomes: too few
/// data, no consensus.
[[nodiscard]] Pose2d2dResult estimate_pose_2d2d(const Camera& camera,
                                                const std::vector<Eigen::Vector2d>& px_ref,
                                                const std::vector<Eigen::Vector2d>& px_cur,
                                                const Pose2d2dOptions& options, Random& random);

}  // namespace placegraph
