#pragma once
#include <placegraph/frontend/internal/labels/scene_labeller.h>
#include <placegraph/frontend/scene/scene_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>

#include <vector>

namespace placegraph {

/// A pixel whose depth two eyes agree on.
struct DepthSample {
  float u = 0, v = 0;                               ///< [px] of the picture
  Eigen::Vector3f point = Eigen::Vector3f::Zero();  ///< camera frame [m]
  int superpixel = 0;
};

/// The ground in front of a camera: a plane, and how much higher or lower it is farther out.
struct GroundProfile {
  /// Too few data: no plane under the camera; then a level one `height_m` below it, if that is
  /// given, stands here all the same.
  Outcome outcome;
  Eigen::Vector3d down = Eigen::Vector3d::UnitY();  ///< unit, camera frame
  double camera_height_m = 0;
  std::vector<double> rise_m;             ///< above the plane, at every kStep_m of z
  static constexpr double kStep_m = 4.0;  ///< between them

  /// Of a point in the camera frame above the ground under it [m].
  double height_of(const Eigen::Vector3d& point) const;
};

/// The plane through what looks like ground and lies before the camera, by least median of squares
/// and reweighting, then medians of what is left over along z. `ground_share`: by superpixel, how
/// probable ground is. `camera_height_m`: 0 where it is not known.
[[nodiscard]] GroundProfile fit_ground(const std::vector<DepthSample>& samples,
                                       const std::vector<float>& ground_share,
                                       double camera_height_m, const UrbanGeometryOptions& options);

/// Where a superpixel is in space.
struct RegionPlace {
  int samples = 0;
  /// 1/z = plane . (x/z, y/z, 1) by robust least squares; zero where there are too few samples.
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
  double disparity_sigma_px = 0;   ///< of the samples about it
  double low_m = 0, height_m = 0;  ///< lowest tenth and median above the ground
  double depth_m = 0;              ///< median
  double upness = 0;               ///< |normal . up|
  double upness_sigma = 1;         ///< large where the plane's turn is not seen
};

/// `disparity_m_px`: focal length times baseline [m px].
std::vector<RegionPlace> place_regions(const std::vector<DepthSample>& samples, int regions,
                                       const Camera& camera, double disparity_m_px,
                                       const GroundProfile& ground,
                                       const UrbanGeometryOptions& options);

/// log P(height, normal | class) of each region, regions x classes: a class is found between two
/// heights above the ground (a table by name, in the source; else by its surface), ground lies flat
/// and walls stand upright. Sky has no depth. What is not known counts nothing.
std::vector<float> geometry_log_likelihoods(const std::vector<RegionPlace>& regions,
                                            const SceneModel& model,
                                            const UrbanGeometryOptions& options);

}  // namespace placegraph
