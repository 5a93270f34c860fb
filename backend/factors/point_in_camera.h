#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace [[gnu::visibility("default")]] placegraph {

/// Minimum depth of a point that can be projected [m].
inline constexpr double kMinDepth_m = 1e-4;
/// Constant residual [sigma] of a point that cannot be projected; its derivatives are zero.
/// A step that moves a point behind a camera raises the cost, and no residual becomes NaN.
inline constexpr double kUnprojectableResidual = 1e3;

/// A map point in a camera's frame: p_cam = R_map_cam^T (p_map - t_map_cam).
///   d p_cam / d xi    = [-I, hat(p_cam)]   (T_map_cam exp(xi), xi = [translation, rotation])
///   d p_cam / d p_map = R_map_cam^T
struct PointInCamera {
  /// Transforms with the rotation and translation of T_map_cam.
  PointInCamera(const Eigen::Matrix3d& R_map_cam, const Eigen::Vector3d& t_map_cam,
                const Eigen::Vector3d& p_map)
      : p_cam(R_map_cam.transpose() * (p_map - t_map_cam)) {}
  /// Transforms with the blocks of a pose [qx, qy, qz, qw, x, y, z] and a point [x, y, z].
  /// Also writes the pose's rotation matrix to `R_map_cam`.
  PointInCamera(const double* pose, const double* point, Eigen::Matrix3d& R_map_cam) {
    R_map_cam = Eigen::Map<const Eigen::Quaterniond>(pose).toRotationMatrix();
    p_cam.noalias() = R_map_cam.transpose() * (Eigen::Map<const Eigen::Vector3d>(point) -
                                               Eigen::Map<const Eigen::Vector3d>(pose + 4));
  }
  /// Whether the depth is above kMinDepth_m and below 1e12 m; false for NaN too.
  bool projectable() const { return p_cam[2] > kMinDepth_m && p_cam[2] < 1e12; }

  Eigen::Vector3d p_cam;  ///< point in the camera frame [m]
};

}  // namespace placegraph
