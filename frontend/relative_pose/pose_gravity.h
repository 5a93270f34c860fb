#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/core/ransac_options.h>
#include <placegraph/graph/geometry/camera.h>

#include <vector>

namespace placegraph {

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

}  // namespace placegraph
