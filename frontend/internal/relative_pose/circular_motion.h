#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>

#include <vector>

namespace placegraph {

struct CircularMotionOptions {
  double threshold_px = 1.0;     ///< inliers lie this close to meeting (Sampson)
  double max_yaw_deg = 30;       ///< between the views
  double bin_deg = 0.05;         ///< of the histogram of votes
  double min_parallax_px = 1.0;  ///< median displacement below which no motion is told
  int min_inliers = 20;
  double min_share = 0.3;  ///< of the points that must agree
  void check() const;
};
void visit(OptionVisitor& field, CircularMotionOptions& options);

struct CircularMotionResult {
  Outcome outcome;
  double yaw_rad = 0;        ///< turn to the right, of the current view against the reference
  double sigma_yaw_rad = 0;  ///< by the points' noise alone, as if the model were exact
  SE3 T_ref_cur;             ///< camera's, |t| = 1
  std::vector<int> inliers;
  double rmse_px = 0;      ///< of the inliers
  double parallax_px = 0;  ///< median displacement that the rotation leaves
};

/// Motion of a car from single points: without side slip a car moves on a circle about a point on
/// its rear axle's line, so that a camera above that axle sees R = R_y(yaw) and
/// t = +-(sin yaw/2, 0, cos yaw/2) in the levelled frame (x right, y down, z ahead), and each point
/// gives the yaw in closed form:
///   tan(yaw/2) = (y_cur x_ref - y_ref x_cur) / (y_ref z_cur + y_cur z_ref)
/// (after Scaramuzza 2011, eq. 8). All points vote; the best of the histogram's highest bins, by
/// the truncated squared Sampson error, is refined on its inliers. A camera a lever L before the
/// rear axle sees its translation turned by L / length more: a first guess, not an estimate, where
/// that counts. `R_level_cam` levels both views. Outcomes: too few data, no consensus, degenerate
/// (parallax below min_parallax_px: the car stands).
[[nodiscard]] CircularMotionResult estimate_circular_motion(
    const Camera& camera, const std::vector<Eigen::Vector2d>& px_ref,
    const std::vector<Eigen::Vector2d>& px_cur, const SO3& R_level_cam,
    const CircularMotionOptions& options);

}  // namespace placegraph
