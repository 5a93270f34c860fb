#pragma once
#include <placegraph/frontend/internal/planes/motion_from_planes.h>
#include <placegraph/frontend/internal/relative_pose/pose_2d2d.h>
#include <placegraph/frontend/internal/relative_pose/rotation_2d2d.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph {

/// What two views are explained by; `kAuto` chooses.
enum class RelativePoseModel { kAuto, kEssential, kHomography, kRotation };
/// "auto", "essential", ..., in the order of the enum.
const std::vector<std::string>& relative_pose_model_names();

struct RelativePoseOptions {
  RelativePoseModel model = RelativePoseModel::kAuto;
  Pose2d2dOptions two_view;
  Rotation2d2dOptions rotation;
  MotionFromPlanesOptions plane;
  double min_parallax_px = 1.0;  ///< median displacement below which no translation is told
  double ambiguity = 0.8;  ///< a second motion with this share of the best one's points is a rival
  void check() const;
};
void visit(OptionVisitor& field, RelativePoseOptions& options);

struct RelativePose {
  Outcome outcome;
  RelativePoseModel model = RelativePoseModel::kAuto;  ///< that was taken
  std::optional<SE3> T_ref_cur;                        ///< |t| = 1; none of a rotation
  std::optional<SO3> R_ref_cur;
  /// Right tangent of T_ref_cur, [translation, rotation], zero along the translation; of a rotation
  /// only its block is there.
  Matrix6d covariance = Matrix6d::Zero();
  std::vector<int> inliers;
  double rmse_px = 0;           ///< of the inliers: from meeting, or of the transfer
  double parallax_px = 0;       ///< median displacement that the rotation leaves
  double homography_share = 0;  ///< R_H of estimate_pose_2d2d
  /// Motions, T_ref_cur with |t| = 1, that explain the views alike: two of one plane. The first is
  /// the likeliest.
  std::vector<SE3> rivals;
};

/// Relative pose of two views, up to scale, by the model that explains them: essential matrix or
/// homography (estimate_pose_2d2d), or, where a rotation moves what they agree on, that alone
/// (estimate_rotation_2d2d). Then refined: on the epipolar errors of the inliers, or motion and
/// plane together (motion_from_planes). Needs a camera without distortion for a homography
/// (ArgumentError). Outcomes: too few data, no consensus, degenerate (a translation is asked for
/// and there is no parallax), inconsistent (rivals; or a rotation is asked for and the camera
/// moved).
[[nodiscard]] RelativePose estimate_relative_pose(const Camera& camera,
                                                  const std::vector<Eigen::Vector2d>& px_ref,
                                                  const std::vector<Eigen::Vector2d>& px_cur,
                                                  const RelativePoseOptions& options,
                                                  Random& random);

}  // namespace placegraph
