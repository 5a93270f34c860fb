#pragma once
#include <placegraph/frontend/internal/planes/homography.h>
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/internal/core/ransac.h>

#include <optional>
#include <vector>

namespace placegraph {

/// How deep a pixel is, as a disparity or a depth camera tells it.
struct InverseDepth {
  Eigen::Vector3d ray_cam = Eigen::Vector3d::UnitZ();  ///< z = 1
  double value = 0;                                    ///< 1 / z [1/m]
  double sigma = 1;                                    ///< [1/m]
};

struct InverseDepthPlane {
  Outcome outcome;
  Plane plane_cam;
  Eigen::Vector3d g_cam = Eigen::Vector3d::Zero();       ///< n / d [1/m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of g_cam
  std::vector<int> inliers;
  double chi2_per_dof = 0;  ///< of the inliers
};

/// What the covariance of n / d says of its normal (the worse of two directions, [rad]) and of its
/// distance (as a share of it).
double sigma_normal_rad(const Eigen::Vector3d& g, const Eigen::Matrix3d& covariance);
double sigma_log_distance(const Eigen::Vector3d& g, const Eigen::Matrix3d& covariance);

/// The plane that most pixels lie on: the inverse depth of a plane n^T X = d is affine in the
/// image, 1/z = (n/d)^T ray, so that three pixels fix it by a linear equation and all inliers by a
/// linear least squares with its covariance, never claimed smaller than the residuals allow. In
/// RANSAC. Outcomes: too few data, no consensus, degenerate (the pixels leave the normal open to
/// max_sigma_deg or the distance to max_sigma_distance, as those of one row do; the plane passes
/// through the eye).
[[nodiscard]] InverseDepthPlane fit_inverse_depth_plane(const std::vector<InverseDepth>& pixels,
                                                        const InverseDepthPlaneOptions& options,
                                                        Random& random);

}  // namespace placegraph
