#pragma once
#include <placegraph/frontend/relative_pose/relative_pose_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/se3.h>

#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Relative pose of two views.
struct RelativePose {
  Outcome outcome;
  RelativePoseModel model = RelativePoseModel::kAuto;  ///< selected model
  std::optional<SE3> T_ref_cur;                        ///< |t| = 1; none for kRotation
  std::optional<SO3> R_ref_cur;
  /// Right tangent of T_ref_cur, [translation, rotation], zero along the translation; for kRotation
  /// only the block of the rotation is set.
  Matrix6d covariance = Matrix6d::Zero();
  std::vector<int> inliers;
  double rmse_px = 0;           ///< rms Sampson or transfer error of the inliers
  double parallax_px = 0;       ///< median displacement after the rotation is removed
  double homography_share = 0;  ///< R_H of estimate_pose_2d2d
  /// Motions, T_ref_cur with |t| = 1, that explain the views equally well: two for a plane. The
  /// first is the most likely.
  std::vector<SE3> rivals;
};

/// Estimates the relative pose of two views, up to scale, by the model that explains them.
///
/// Essential matrix or homography (estimate_pose_2d2d), or a pure rotation (estimate_rotation_2d2d)
/// if it explains the inliers. The pose is refined on the epipolar errors of the inliers, or
/// together with the plane (motion_from_planes). A homography needs a camera without distortion
/// (ArgumentError). Outcomes: too few data, no consensus, degenerate (a translation is requested
/// and there is no parallax), inconsistent (rivals; or a rotation is requested and the camera
/// translated).
[[nodiscard]] RelativePose estimate_relative_pose(const Camera& camera,
                                                  const std::vector<Eigen::Vector2d>& px_ref,
                                                  const std::vector<Eigen::Vector2d>& px_cur,
                                                  const RelativePoseOptions& options,
                                                  Random& random);

}  // namespace placegraph
