#pragma once
#include <placegraph/frontend/relative_pose/relative_pose_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/core/ransac_options.h>
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

/// Options of the relative pose with known vertical.
struct GravityPoseOptions {
  RansacOptions ransac{.max_iterations = 200, .confidence = 0.999, .min_inliers = 20};
  double threshold_px = 1.0;       ///< maximum Sampson error of an inlier
  double sigma_gravity_deg = 0.3;  ///< error of each view's vertical about each horizontal axis
  double min_parallax_px = 1.0;    ///< least median displacement for a translation
  void check() const;
};
void visit(OptionVisitor& field, GravityPoseOptions& options);

/// Relative pose of two views with known vertical.
struct GravityPoseResult {
  Outcome outcome;
  SE3 T_ref_cur;  ///< |t| = 1; only the rotation is meaningful if degenerate
  std::vector<int> inliers;
  double rmse_px = 0;      ///< root mean square error of the inliers
  double parallax_px = 0;  ///< median displacement after the rotation is removed
  /// Right tangent of T_ref_cur, that of the verticals included; zero along the translation.
  Matrix6d information = Matrix6d::Zero();
};

/// Estimates the relative pose up to scale of two views with known vertical.
///
/// The verticals are unit vectors that point down in each camera. With both views levelled only the
/// heading and the direction of the translation are unknown, which three points determine:
/// det M(q) = 0 with M's rows R_y(q) y_cur x y_ref, a quartic in the tangent q of half the
/// heading's change (Fraundorfer, Tanskanen & Pollefeys 2010), in RANSAC. Then all five degrees of
/// freedom are refined on the Huber-weighted Sampson error and the verticals. Outcomes: too few
/// data, no consensus, degenerate (parallax below min_parallax_px).
[[nodiscard]] GravityPoseResult estimate_pose_with_gravity(
    const Camera& camera, const std::vector<Eigen::Vector2d>& px_ref,
    const std::vector<Eigen::Vector2d>& px_cur, const Eigen::Vector3d& down_ref,
    const Eigen::Vector3d& down_cur, const GravityPoseOptions& options, Random& random);

/// Options of the circular motion of a car.
struct CircularMotionOptions {
  double threshold_px = 1.0;     ///< maximum Sampson error of an inlier
  double max_yaw_deg = 30;       ///< maximum yaw between the views
  double bin_deg = 0.05;         ///< bin width of the histogram of votes
  double min_parallax_px = 1.0;  ///< least median displacement for an estimate
  int min_inliers = 20;          ///< minimum number of inliers
  double min_share = 0.3;        ///< minimum share of inliers
  void check() const;
};
void visit(OptionVisitor& field, CircularMotionOptions& options);

/// Circular motion of a car.
struct CircularMotionResult {
  Outcome outcome;
  double yaw_rad = 0;        ///< rotation of the current view to the right of the reference
  double sigma_yaw_rad = 0;  ///< from the points' noise only, for an exact model
  SE3 T_ref_cur;             ///< motion of the camera, |t| = 1
  std::vector<int> inliers;
  double rmse_px = 0;      ///< root mean square error of the inliers
  double parallax_px = 0;  ///< median displacement after the rotation is removed
};

/// Estimates the motion of a car from single points.
///
/// Without side slip a car moves on a circle about a point on its rear axle's line, so that a
/// camera above that axle has R = R_y(yaw) and t = +-(sin yaw/2, 0, cos yaw/2) in the levelled
/// frame (x right, y down, z ahead), and each point determines the yaw in closed form:
///   tan(yaw/2) = (y_cur x_ref - y_ref x_cur) / (y_ref z_cur + y_cur z_ref)
/// (after Scaramuzza 2011, eq. 8). All points vote; the best of the histogram's highest bins, by
/// the truncated squared Sampson error, is refined on its inliers. For a camera at a lever arm L
/// before the rear axle the translation is rotated by L / length more: if that is significant, the
/// result is only a first guess. `R_level_cam` levels both views. Outcomes: too few data, no
/// consensus, degenerate (parallax below min_parallax_px: the car is stationary).
[[nodiscard]] CircularMotionResult estimate_circular_motion(
    const Camera& camera, const std::vector<Eigen::Vector2d>& px_ref,
    const std::vector<Eigen::Vector2d>& px_cur, const SO3& R_level_cam,
    const CircularMotionOptions& options);

/// A point with its covariance.
struct CloudPoint {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();           ///< [m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< [m^2], full rank
};

/// The point of a pixel with inverse depth [1/m], with its covariance to first order.
///
/// The standard deviation is `sigma_px` across the ray and `sigma_inverse_depth` [1/m] along it
/// (stereo: sigma of the disparity / (f baseline)). Throws ArgumentError for a pixel outside the
/// lens model or an inverse depth that is not positive.
CloudPoint cloud_point(const Camera& camera, const Eigen::Vector2d& px, double inverse_depth,
                       double sigma_px, double sigma_inverse_depth);

/// Options of the pose between two point clouds.
struct Pose3d3dOptions {
  RansacOptions ransac{.max_iterations = 200, .confidence = 0.999, .min_inliers = 12};
  double threshold_sigmas =
      3.4;  ///< maximum error of an inlier; chi2 of three degrees of freedom, 99 %
  void check() const;
};
void visit(OptionVisitor& field, Pose3d3dOptions& options);

/// Pose between two point clouds.
struct Pose3d3dResult {
  Outcome outcome;
  SE3 T_ref_cur;
  std::vector<int> inliers;
  double chi2_per_dof = 0;  ///< chi2 of the inliers; 1 if the covariances are correct
  Matrix6d information = Matrix6d::Zero();  ///< right tangent of T_ref_cur; reduced if the
  ///< residuals exceed the covariances
};

/// Estimates the pose between two clouds of corresponding points.
///
/// Three points (Arun et al. 1987, by OpenGV) in RANSAC, then Gauss-Newton on the Huber-weighted
/// distances |p_ref - T_ref_cur p_cur|, each with the covariance C_ref + R C_cur R^T of the two.
/// With stereo the depths of far points have almost no weight, but their directions are used.
/// Outcomes: too few data, no consensus, degenerate (points on a line).
[[nodiscard]] Pose3d3dResult estimate_pose_3d3d(const std::vector<CloudPoint>& points_ref,
                                                const std::vector<CloudPoint>& points_cur,
                                                const Pose3d3dOptions& options, Random& random);

}  // namespace placegraph
