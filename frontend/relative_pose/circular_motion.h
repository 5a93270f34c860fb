#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>

#include <vector>

namespace placegraph {

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

}  // namespace placegraph
