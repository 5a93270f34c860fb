#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/core/ransac_options.h>
#include <placegraph/graph/geometry/camera.h>

#include <vector>

namespace placegraph {

/// A point with its covariance.
struct CloudPoint {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();           ///< [m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< [m^2], full rank
};

/// The point of a pixel with inverse depth [1/m], with its covariance to first order.
///
/// The standard deviation is `sigma_px` across the ray and `sigma_inverse_depth` [1/m] along it
/// (stereo: sigma of the disparity / (f baseline)). Throws ArgumentError for a pixel outside the
/// lens model or an inverse depth that is not positive.
CloudPoint cloud_point(const Camera& camera, const Eigen::Vector2d& px, double inverse_depth,
                       double sigma_px, double sigma_inverse_depth);

/// Options of the pose between two point clouds.
struct Pose3d3dOptions {
  RansacOptions ransac{.max_iterations = 200, .confidence = 0.999, .min_inliers = 12};
  double threshold_sigmas =
      3.4;  ///< maximum error of an inlier; chi2 of three degrees of freedom, 99 %
  void check() const;
};
void visit(OptionVisitor& field, Pose3d3dOptions& options);

/// Pose between two point clouds.
struct Pose3d3dResult {
  Outcome outcome;
  SE3 T_ref_cur;
  std::vector<int> inliers;
  double chi2_per_dof = 0;  ///< chi2 of the inliers; 1 if the covariances are correct
  Matrix6d information = Matrix6d::Zero();  ///< right tangent of T_ref_cur; reduced if the
  ///< residuals exceed the covariances
};

/// Estimates the pose between two clouds of corresponding points.
///
/// Three points (Arun et al. 1987, by OpenGV) in RANSAC, then Gauss-Newton on the Huber-weighted
/// distances |p_ref - T_ref_cur p_cur|, each with the covariance C_ref + R C_cur R^T of the two.
/// With stereo the depths of far points have almost no weight, but their directions are used.
/// Outcomes: too few data, no consensus, degenerate (points on a line).
[[nodiscard]] Pose3d3dResult estimate_pose_3d3d(const std::vector<CloudPoint>& points_ref,
                                                const std::vector<CloudPoint>& points_cur,
                                                const Pose3d3dOptions& options, Random& random);

}  // namespace placegraph
