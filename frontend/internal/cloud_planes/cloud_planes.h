#pragma once
#include <placegraph/frontend/internal/cloud_planes/cloud_planes_options.h>
#include <placegraph/frontend/internal/cloud_planes/cloud_points.h>
#include <placegraph/frontend/internal/cloud_planes/planarity.h>
#include <placegraph/graph/core/outcome.h>

#include <vector>

namespace placegraph {

struct CloudPlane {
  Plane plane;  ///< in the sensor's frame, distance_m >= 0
  /// Of the closest point n d [m], never claimed smaller than the residuals allow.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  int points = 0;
  double probability = 1;   ///< of being a plane, by its looks; 1 with the other methods
  double chi2_per_dof = 0;  ///< of its points, against the noise alone
};

struct CloudPlanesResult {
  Outcome outcome;                 ///< too few data; a cloud without planes is ok
  std::vector<CloudPlane> planes;  ///< the largest first
  std::vector<int> labels;         ///< of each point of the cloud: 0 none, k planes[k - 1]
  CloudNoise noise;                ///< as measured
  bool from_origin = true;  ///< one surface along every ray: the sensor is where it should be
};

/// The planes of a cloud and what lies on them, at any scale. Super-points, normalized cuts
/// of their graph by planar dissimilarity (Shi & Malik 2000), learned planarity of the segments,
/// pruning, coplanar segments taken together, RANSAC and least squares in each, then every point
/// to the plane it lies on. Throws ArgumentError for options or sizes that cannot be.
[[nodiscard]] CloudPlanesResult find_cloud_planes(const PointCloud& cloud,
                                                  const CloudPlanesOptions& options,
                                                  const PlanarityModel& planarity);

/// Segments as they are judged, for whoever trains: what `find_cloud_planes` asks the model about.
struct JudgedSegments {
  CloudPoints points;
  SuperPoints cloud;
  std::vector<PlanarSegment> segments;
  std::vector<PlanarityFeatures> features;
};
JudgedSegments segments_to_judge(const PointCloud& cloud, const CloudPlanesOptions& options);

}  // namespace placegraph
