#pragma once
#include <placegraph/frontend/planes/homography.h>
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/core/ransac.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Inverse depth of a pixel, measured by stereo disparity or a depth camera.
struct MeasuredInverseDepth {
  Eigen::Vector3d ray_cam = Eigen::Vector3d::UnitZ();  ///< viewing ray, z = 1
  double value = 0;                                    ///< 1 / z [1/m]
  double sigma = 1;                                    ///< standard deviation of value [1/m]
  /// g of the plane g^T X = 1 through the depths around the pixel; zero: not known.
  Eigen::Vector3d surface_cam = Eigen::Vector3d::Zero();
};

struct InverseDepthPlane {
  Outcome outcome;
  Plane plane_cam;
  Eigen::Vector3d g_cam = Eigen::Vector3d::Zero();       ///< n / d [1/m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< covariance of g_cam
  std::vector<int> inliers;
  double chi2_per_dof = 0;  ///< chi2 of the inliers over their degrees of freedom
};

/// Standard deviations from the covariance of n / d: that of the normal (the worse of two
/// directions, [rad]), and the relative one of the distance.
double sigma_normal_rad(const Eigen::Vector3d& g, const Eigen::Matrix3d& covariance);
double sigma_log_distance(const Eigen::Vector3d& g, const Eigen::Matrix3d& covariance);

/// Fits the plane with the most pixels by RANSAC.
///
/// The inverse depth of a plane n^T X = d is affine in the image, 1/z = (n/d)^T ray, so that three
/// pixels determine it by a linear equation and all inliers by linear least squares. The covariance
/// is at least that of the residuals. Outcomes: too few data, no consensus, degenerate (the pixels
/// do not determine the normal to max_sigma_deg or the distance to max_sigma_distance, as those of
/// one row; or the plane passes through the camera centre).
[[nodiscard]] InverseDepthPlane fit_inverse_depth_plane(
    const std::vector<MeasuredInverseDepth>& pixels, const InverseDepthPlaneOptions& options,
    Random& random);

}  // namespace placegraph
