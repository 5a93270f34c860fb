#pragma once
#include <placegraph/frontend/relative_pose/relative_pose_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/camera.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Pose of a camera from points.
struct Pose3d2dResult {
  Outcome outcome;
  SE3 T_ref_cam;             ///< camera in the frame of the points; meaningful only if outcome
  std::vector<int> inliers;  ///< ascending
  double rmse_px = 0;        ///< root mean square error of the inliers per axis
  Matrix6d information = Matrix6d::Zero();  ///< right tangent of T_ref_cam, J^T J / sigma^2
};

/// Estimates a camera's pose from 3-D points and their pixels.
///
/// Three-point minimal solver (Kneip et al. 2011, by OpenGV) in RANSAC, then Gauss-Newton on the
/// Huber-weighted reprojection error. `prior` (T_ref_cam), if given, is refined first; RANSAC is
/// skipped if enough points are its inliers. Outcomes: too few data (< min_inliers), no consensus,
/// degenerate (normal matrix not invertible).
[[nodiscard]] Pose3d2dResult estimate_pose_3d2d(const Camera& camera,
                                                const std::vector<Eigen::Vector3d>& points_ref,
                                                const std::vector<Eigen::Vector2d>& px,
                                                const Pose3d2dOptions& options, Random& random,
                                                const SE3* prior = nullptr);

/// Refines T_ref_cam by Gauss-Newton on the reprojection errors of the points `indices`.
///
/// Huber width `huber_px`. `normal`, if given, receives J^T W J [1/px^2].
SE3 refine_pose_3d2d(const Camera& camera, const std::vector<Eigen::Vector3d>& points_ref,
                     const std::vector<Eigen::Vector2d>& px, const std::vector<int>& indices,
                     const SE3& T_ref_cam, double huber_px, int iterations,
                     Matrix6d* normal = nullptr);

}  // namespace placegraph
