#pragma once
#include <placegraph/frontend/labels/scene_labeller.h>
#include <placegraph/frontend/scene/street_labelling_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>

#include <vector>

namespace placegraph {

/// Pixel with a depth on which both cameras agree.
struct DepthSample {
  float u = 0, v = 0;                               ///< pixel coordinates in the image [px]
  Eigen::Vector3f point = Eigen::Vector3f::Zero();  ///< position in the camera frame [m]
  int superpixel = 0;
};

/// Ground in front of a camera: a plane, and deviations from it farther away.
struct GroundProfile {
  /// Too few data: there is no plane under the camera; if `height_m` is given, the result is still
  /// a level plane at this distance below it.
  Outcome outcome;
  Eigen::Vector3d down = Eigen::Vector3d::UnitY();  ///< unit vector, camera frame
  double camera_height_m = 0;
  std::vector<double> rise_m;  ///< height of the ground above the plane, at every kStep_m of z
  static constexpr double kStep_m = 4.0;  ///< distance between these heights

  /// Height of a point in the camera frame above the ground under it [m].
  double height_of(const Eigen::Vector3d& point) const;
};

/// Fits the plane through probable ground in front of the camera.
///
/// Least median of squares and reweighting, then medians of the residuals along z. `ground_share`:
/// probability of ground, by superpixel. `camera_height_m`: 0 if it is unknown.
[[nodiscard]] GroundProfile fit_ground(const std::vector<DepthSample>& samples,
                                       const std::vector<float>& ground_share,
                                       double camera_height_m);

/// Position of a superpixel in space.
struct RegionPlace {
  int samples = 0;
  /// 1/z = plane . (x/z, y/z, 1) by robust least squares; zero with too few samples.
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
  double disparity_sigma_px = 0;   ///< dispersion of the samples about the plane
  double low_m = 0, height_m = 0;  ///< lowest tenth and median of the heights above the ground
  double depth_m = 0;              ///< median depth
  double upness = 0;               ///< |normal . up|
  /// Standard deviation of upness; large if the plane's inclination is not observable.
  double upness_sigma = 1;
};

/// Computes the positions of all regions. `disparity_m_px`: focal length times baseline [m px].
std::vector<RegionPlace> place_regions(const std::vector<DepthSample>& samples, int regions,
                                       const Camera& camera, double disparity_m_px,
                                       const GroundProfile& ground);

/// log P(height, normal | class) of each region, regions x classes.
///
/// A class occurs between two heights above the ground (a table by name, in the source; otherwise
/// by its surface); ground is flat and walls are upright. Sky has no depth. Unknown quantities do
/// not count.
std::vector<float> geometry_log_likelihoods(const std::vector<RegionPlace>& regions,
                                            const SceneModel& model,
                                            const StreetGeometryOptions& options);

}  // namespace placegraph
