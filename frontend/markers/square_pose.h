#pragma once
#include <placegraph/frontend/markers/square_fit.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/se3.h>

#include <vector>

namespace placegraph {

/// A square of known corners and their observation in an image.
struct SeenSquare {
  SquareCorners corners_px;
  std::array<Eigen::Vector3d, 4> corners_ref;
  Eigen::Matrix<double, 8, 8> information = Eigen::Matrix<double, 8, 8>::Identity();  ///< [1/px^2]
};

/// A known point and its observation in an image.
struct SeenPoint {
  Eigen::Vector2d px = Eigen::Vector2d::Zero();
  Eigen::Vector3d point_ref = Eigen::Vector3d::Zero();
  Eigen::Matrix2d information = Eigen::Matrix2d::Identity();  ///< [1/px^2]
};

/// Pose of a camera from squares and points.
struct SquarePose {
  Outcome outcome;
  SE3 T_ref_cam;
  Matrix6d covariance = Matrix6d::Zero();  ///< right tangent
  double chi2 = 0;                         ///< sum of squared errors
  int rows = 0;                            ///< residuals in `chi2`
};

/// Refines the camera's pose on all squares and points together by Levenberg-Marquardt.
///
/// The result is the minimum of the squared errors, each in its own information, next to
/// `T_ref_cam`. Outcomes: too few data (fewer than six residuals), degenerate (a direction is
/// undetermined), no consensus (a corner or point is behind the camera), not converged.
[[nodiscard]] SquarePose refine_square_pose(const Camera& camera,
                                            const std::vector<SeenSquare>& squares,
                                            const std::vector<SeenPoint>& points,
                                            const SE3& T_ref_cam);

/// Second pose of coplanar squares and points beside the minimum at `T_ref_cam`.
///
/// The tilt against the viewing direction to `centre_ref` is mirrored, then the pose is refined. If
/// that returns to the same minimum, as it does if noise has removed the other one, the pose is
/// refined with its tilt constant: not a minimum, but equally possible. Outcomes as above;
/// inconsistent if tilt and mirrored tilt are equal within `apart_rad`.
[[nodiscard]] SquarePose find_planar_rival(const Camera& camera,
                                           const std::vector<SeenSquare>& squares,
                                           const std::vector<SeenPoint>& points,
                                           const SE3& T_ref_cam, const Eigen::Vector3d& centre_ref,
                                           const Eigen::Vector3d& normal_ref,
                                           double apart_rad = 0.01);

/// Whether two poses are the same minimum: within a tenth of the first's standard deviations.
///
/// The error is flat near a minimum, and descents end where the remaining distance is negligible.
bool same_minimum(const SquarePose& a, const SquarePose& b);

/// Squared error of one square in its information; infinite behind the camera.
double square_chi2(const Camera& camera, const SeenSquare& square, const SE3& T_ref_cam);
double point_chi2(const Camera& camera, const SeenPoint& point, const SE3& T_ref_cam);

}  // namespace placegraph
