#pragma once
#include <placegraph/frontend/relative_pose/relative_pose_options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/internal/core/ransac.h>

#include <vector>

namespace placegraph {

struct Rotation2d2dResult {
  Outcome outcome;
  SO3 R_ref_cur;  ///< meaningful only if outcome
  /// Of the right tangent of R_ref_cur [rad^2]; what way the threshold would have let pass is
  /// among it.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::vector<int> inliers;
  double rmse_px = 0;  ///< of the inliers
};

/// Rotation between two views that share their centre: x_cur = R_ref_cur^T x_ref up to length. Two
/// points in RANSAC, all of the inliers afterwards (Arun et al. 1987, both by OpenGV), then least
/// squares of their pixels. Throws ArgumentError if the lists differ in length. Outcomes: too few
/// data, no consensus, inconsistent (too small a share agrees: the camera moved), degenerate (all
/// in one direction).
[[nodiscard]] Rotation2d2dResult estimate_rotation_2d2d(const Camera& camera,
                                                        const std::vector<Eigen::Vector2d>& px_ref,
                                                        const std::vector<Eigen::Vector2d>& px_cur,
                                                        const Rotation2d2dOptions& options,
                                                        Random& random);

}  // namespace placegraph
