#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/internal/core/ransac.h>

#include <vector>

namespace placegraph {

struct GravityPoseOptions {
  RansacOptions ransac{.max_iterations = 200, .confidence = 0.999, .min_inliers = 20};
  double threshold_px = 1.0;       ///< inliers lie this close to meeting (Sampson)
  double sigma_gravity_deg = 0.3;  ///< of each view's vertical, about each level axis
  double min_parallax_px = 1.0;    ///< median displacement below which no translation is told
  void check() const;
};
void visit(OptionVisitor& field, GravityPoseOptions& options);

struct GravityPoseResult {
  Outcome outcome;
  SE3 T_ref_cur;  ///< |t| = 1; of a degenerate motion only the rotation means something
  std::vector<int> inliers;
  double rmse_px = 0;      ///< of the inliers
  double parallax_px = 0;  ///< median displacement that the rotation leaves
  /// Of T_ref_cur, right tangent, the vertical's included; nothing along the translation.
  Matrix6d information = Matrix6d::Zero();
};

/// Relative pose up to scale of two views whose vertical is known, as unit vectors that point down
/// in each camera: with both views levelled only the heading and the direction of the translation
/// are left, which three points fix: det M(q) = 0 with M's rows R_y(q) y_cur x y_ref, a quartic in
/// the tangent q of half the heading's change (Fraundorfer, Tanskanen & Pollefeys 2010). In RANSAC;
/// then all five degrees of freedom on the Huber-weighted Sampson error and the verticals.
/// Outcomes: too few data, no consensus, degenerate (parallax below min_parallax_px).
[[nodiscard]] GravityPoseResult estimate_pose_with_gravity(
    const Camera& camera, const std::vector<Eigen::Vector2d>& px_ref,
    const std::vector<Eigen::Vector2d>& px_cur, const Eigen::Vector3d& down_ref,
    const Eigen::Vector3d& down_cur, const GravityPoseOptions& options, Random& random);

}  // namespace placegraph
