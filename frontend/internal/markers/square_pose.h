#pragma once
#include <placegraph/frontend/internal/markers/square_fit.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/se3.h>

#include <vector>

namespace placegraph {

/// A square of known corners and where an image shows them.
struct SeenSquare {
  SquareCorners corners_px;
  std::array<Eigen::Vector3d, 4> corners_ref;
  Eigen::Matrix<double, 8, 8> information = Eigen::Matrix<double, 8, 8>::Identity();  ///< 1/px^2
};

/// A known point and where an image shows it.
struct SeenPoint {
  Eigen::Vector2d px = Eigen::Vector2d::Zero();
  Eigen::Vector3d point_ref = Eigen::Vector3d::Zero();
  Eigen::Matrix2d information = Eigen::Matrix2d::Identity();  ///< 1/px^2
};

struct SquarePose {
  Outcome outcome;
  SE3 T_ref_cam;
  Matrix6d covariance = Matrix6d::Zero();  ///< right tangent
  double chi2 = 0;
  int rows = 0;  ///< residuals in `chi2`
};

/// The camera's pose at the minimum next to `T_ref_cam` of the squared errors of all squares and
/// points together, each in its own information: Levenberg-Marquardt. Outcomes: too few data (fewer
/// than six residuals), degenerate (a direction stays open), no consensus (something of it behind
/// the camera), not converged.
[[nodiscard]] SquarePose refine_square_pose(const Camera& camera,
                                            const std::vector<SeenSquare>& squares,
                                            const std::vector<SeenPoint>& points,
                                            const SE3& T_ref_cam);

/// The pose that what lies in a plane is taken for beside the one at `T_ref_cam`, a minimum: its
/// tilt against the line of sight to `centre_ref` mirrored, then refined; where that falls back to
/// the same minimum, as it does where noise has filled the other one up, refined with its tilt as
/// it is: no minimum, but no less possible for that. Outcomes as above; inconsistent where tilt and
/// mirrored tilt are the same within `apart_rad`.
[[nodiscard]] SquarePose find_planar_rival(const Camera& camera,
                                           const std::vector<SeenSquare>& squares,
                                           const std::vector<SeenPoint>& points,
                                           const SE3& T_ref_cam, const Eigen::Vector3d& centre_ref,
                                           const Eigen::Vector3d& normal_ref,
                                           double apart_rad = 0.01);

/// Whether two poses are one minimum: nearer to each other than a tenth of what is known of the
/// first. Valleys are flat, and descents end where they no longer matter.
bool same_minimum(const SquarePose& a, const SquarePose& b);

/// Squared error of one square, in its information; infinite behind the camera.
double square_chi2(const Camera& camera, const SeenSquare& square, const SE3& T_ref_cam);
double point_chi2(const Camera& camera, const SeenPoint& point, const SE3& T_ref_cam);

}  // namespace placegraph
