#pragma once
#include <ceres/sized_cost_function.h>
#include <placegraph/backend/factors/point_in_camera.h>
#include <placegraph/graph/core/camera.h>

namespace placegraph {

/// Reprojection of a map point, undistorted pinhole camera, in standard deviations:
///
///   r = ([fx x/z + cx, fy y/z + cy] - observed_px) / sigma_px,      [x y z] = p_cam
///   A = d r / d p_cam = [fx/z, 0, -fx x/z^2; 0, fy/z, -fy y/z^2] / sigma_px
///   d r / d xi = A [-I, hat(p_cam)],   d r / d p_map = A R_map_cam^T
struct Reprojection {
  double fx, fy, cx, cy;  ///< [px]
  double u, v;            ///< observed [px]
  double inverse_sigma;   ///< [1/px]

  Reprojection(const Camera& camera, const Eigen::Vector2d& px, double sigma_px)
      : fx(camera.fx),
        fy(camera.fy),
        cx(camera.cx),
        cy(camera.cy),
        u(px[0]),
        v(px[1]),
        inverse_sigma(1.0 / sigma_px) {}

  static constexpr int kRows = 2;
  /// `p_cam` must be projectable.
  Eigen::Vector2d residual(const Eigen::Vector3d& p_cam) const {
    return {(fx * p_cam[0] / p_cam[2] + cx - u) * inverse_sigma,
            (fy * p_cam[1] / p_cam[2] + cy - v) * inverse_sigma};
  }
  /// A, as above.
  Eigen::Matrix<double, 2, 3> derivative(const Eigen::Vector3d& p_cam) const {
    const double a = fx * inverse_sigma / p_cam[2], b = fy * inverse_sigma / p_cam[2];
    Eigen::Matrix<double, 2, 3> A;
    A << a, 0, -a * p_cam[0] / p_cam[2], 0, b, -b * p_cam[1] / p_cam[2];
    return A;
  }
};

}  // namespace placegraph
