#pragma once
#include <placegraph/backend/factors/point_in_camera.h>
#include <placegraph/graph/geometry/camera.h>

#include <cmath>

namespace [[gnu::visibility("default")]] placegraph {

/// Reprojection error of a map point in an undistorted pinhole camera, whitened:
///
///   r = W ([fx x/z + cx, fy y/z + cy] - observed_px),      [x y z] = p_cam, W^T W = covariance^-1
///   A = d r / d p_cam = W [fx/z, 0, -fx x/z^2; 0, fy/z, -fy y/z^2]
///   d r / d xi = A [-I, hat(p_cam)],   d r / d p_map = A R_map_cam^T
struct Reprojection {
  double fx, fy, cx, cy;  ///< intrinsics [px]
  double u, v;            ///< observed pixel [px]
  double w00, w10, w11;   ///< W, lower triangular [1/px]

  /// An observed pixel with one standard deviation; the camera's distortion is ignored.
  Reprojection(const Camera& camera, const Eigen::Vector2d& px, double sigma_px)
      : fx(camera.fx),
        fy(camera.fy),
        cx(camera.cx),
        cy(camera.cy),
        u(px[0]),
        v(px[1]),
        w00(1 / sigma_px),
        w10(0),
        w11(w00) {}
  /// An observed pixel with a covariance [px^2], which must be positive definite.
  Reprojection(const Camera& camera, const Eigen::Vector2d& px, const Eigen::Matrix2d& covariance)
      : Reprojection(camera, px, std::sqrt(covariance(0, 0))) {
    // The inverse of the covariance's Cholesky factor.
    const double l10 = covariance(1, 0) * w00;
    w11 = 1 / std::sqrt(covariance(1, 1) - l10 * l10);
    w10 = -l10 * w00 * w11;
  }

  static constexpr int kRows = 2;  ///< rows of the residual
  /// W times an error [px]: the error in standard deviations.
  Eigen::Vector2d whiten(const Eigen::Vector2d& error_px) const {
    return {w00 * error_px[0], w10 * error_px[0] + w11 * error_px[1]};
  }
  /// r, as above; `p_cam` must be projectable, see PointInCamera.
  Eigen::Vector2d residual(const Eigen::Vector3d& p_cam) const {
    return whiten({fx * p_cam[0] / p_cam[2] + cx - u, fy * p_cam[1] / p_cam[2] + cy - v});
  }
  /// A, as above.
  Eigen::Matrix<double, 2, 3> derivative(const Eigen::Vector3d& p_cam) const {
    const double a = fx / p_cam[2], b = fy / p_cam[2];
    const double x = p_cam[0] / p_cam[2], y = p_cam[1] / p_cam[2];
    Eigen::Matrix<double, 2, 3> A;
    A << w00 * a, 0, -w00 * a * x, w10 * a, w11 * b, -w10 * a * x - w11 * b * y;
    return A;
  }
};

}  // namespace placegraph
