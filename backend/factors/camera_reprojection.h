#pragma once
#include <placegraph/backend/factors/point_observation.h>
#include <placegraph/graph/geometry/camera.h>

#include <cmath>

namespace placegraph {

/// Reprojection error [px] of a point in a camera with any distortion, for PointObservationFactor:
///
///   r = (project(p_cam) - observed_px) / sigma,   A = d r / d p_cam
///
/// The residual is kUnprojectableResidual, and A zero, where the distortion has no pixel.
struct CameraReprojection {
  Camera camera;        ///< camera with its distortion
  Eigen::Vector2d px;   ///< observed pixel
  double sigma_px = 1;  ///< its standard deviation

  static constexpr int kRows = 2;  ///< rows of the residual
  /// r, as above.
  Eigen::Vector2d residual(const Eigen::Vector3d& p_cam) const {
    const auto projected = camera.project(p_cam);
    if (!projected) return {kUnprojectableResidual, 0};
    return (*projected - px) / sigma_px;
  }
  /// A, as above.
  Eigen::Matrix<double, 2, 3> derivative(const Eigen::Vector3d& p_cam) const {
    Eigen::Matrix<double, 2, 3> A;
    if (!camera.project(p_cam, &A)) return Eigen::Matrix<double, 2, 3>::Zero();
    return A / sigma_px;
  }
};

}  // namespace placegraph
