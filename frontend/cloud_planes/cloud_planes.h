#pragma once
#include <placegraph/frontend/cloud_planes/cloud_planes_options.h>
#include <placegraph/frontend/planes/homography.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/measurements/point_cloud.h>

#include <Eigen/Core>
#include <algorithm>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

struct PlanarityModel;

/// Standard deviation of a point: `at_1m` times depth to the `power` [m].
///
/// Power 0: constant, 1: a share of the depth (laser), 2: a constant disparity (stereo, depth
/// cameras).
struct CloudNoise {
  double at_1m = 0;
  int power = 1;
  double least_m = 0;  ///< least value, from the quantization of the depths
  double shared = 0;   ///< in an image: variance that neighbours have in common, over their own
  double sigma(double depth_m) const {
    constexpr double kLeastShare = 1e-5;  // of the depth: less noise than that is rounding
    const double factor = power == 0 ? 1 : power == 1 ? depth_m : depth_m * depth_m;
    return std::max({at_1m * factor, least_m, kLeastShare * depth_m});
  }
};

/// A plane in a point cloud.
struct CloudPlane {
  Plane plane;  ///< plane in the sensor's frame, distance_m >= 0
  /// Covariance of the closest point n d [m], at least that of the residuals.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  int points = 0;
  /// Probability of a plane, from the segment's features; 1 with the other methods.
  double probability = 1;
  /// Chi2 of its points over their degrees of freedom, for the noise alone.
  double chi2_per_dof = 0;
};

/// The planes of a point cloud.
struct CloudPlanesResult {
  Outcome outcome;                 ///< too few data; a cloud without planes is ok
  std::vector<CloudPlane> planes;  ///< planes, the largest first
  std::vector<int> labels;         ///< label of each point of the cloud: 0 none, k planes[k - 1]
  CloudNoise noise;                ///< measured noise
  bool from_origin = true;         ///< one surface along every ray: the sensor is at the origin
};

/// Finds the planes of a cloud and the points on them, at any scale.
///
/// Super-points, normalized cuts of their graph by planar dissimilarity (Shi & Malik 2000), learned
/// planarity of the segments, pruning, merging of coplanar segments, RANSAC and least squares in
/// each, then assignment of every point to its plane. Throws ArgumentError for invalid options or
/// sizes.
[[nodiscard]] CloudPlanesResult find_cloud_planes(const PointCloud& cloud,
                                                  const CloudPlanesOptions& options,
                                                  const PlanarityModel& planarity);

}  // namespace placegraph
