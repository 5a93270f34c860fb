#pragma once
#include <placegraph/frontend/relative_pose/relative_pose_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/camera.h>

#include <vector>

namespace placegraph {

/// Rotation between two views.
struct Rotation2d2dResult {
  Outcome outcome;
  SO3 R_ref_cur;  ///< meaningful only if outcome
  /// Covariance of the right tangent of R_ref_cur [rad^2], including the effect of a translation
  /// below the threshold.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::vector<int> inliers;
  double rmse_px = 0;  ///< root mean square error of the inliers
};

/// Estimates the rotation between two views with the same centre.
///
/// x_cur = R_ref_cur^T x_ref up to length. Two points in RANSAC, then all inliers (Arun et al.
/// 1987, both by OpenGV), then least squares of their pixels. Throws ArgumentError if the lists
/// differ in length. Outcomes: too few data, no consensus, inconsistent (the share of inliers is
/// too small: the camera translated), degenerate (all points in one direction).
[[nodiscard]] Rotation2d2dResult estimate_rotation_2d2d(const Camera& camera,
                                                        const std::vector<Eigen::Vector2d>& px_ref,
                                                        const std::vector<Eigen::Vector2d>& px_cur,
                                                        const Rotation2d2dOptions& options,
                                                        Random& random);

}  // namespace placegraph
