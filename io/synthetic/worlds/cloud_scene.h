#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/measurements/point_cloud.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {
namespace synthetic {

/// Solids that a ray may hit, each a unit solid in its own frame before scaling.
enum class SolidKind {
  kBox,       ///< |x|, |y|, |z| <= 1: six planes
  kRoom,      ///< the same, seen from inside
  kBall,      ///< |p| <= 1: scaled, an ellipsoid
  kCylinder,  ///< x^2 + y^2 <= 1, |z| <= 1: its two ends are planes
};

/// A solid of a scene.
struct Solid {
  SolidKind kind = SolidKind::kBox;
  SE3 T_sensor_solid;
  Eigen::Vector3d half = Eigen::Vector3d::Ones();  ///< half its sides [m]
  int first_label = 1;  ///< label of its first plane, the others follow; curved faces have 0
};

/// Options of the simulated sensor of a cloud.
struct CloudSensor {
  /// A scan, even in azimuth and elevation, without an image; otherwise a pinhole.
  bool scans = false;
  int width = 160, height = 120;
  double focal_px = 150;   ///< focal length of the pinhole [px]
  double step_rad = 0.01;  ///< angular step of the scan [rad]
  double noise_share = 0;  ///< noise as a share of the depth; see noise_power
  /// Standard deviation = noise_share * depth_scale * (depth / depth_scale)^power.
  double noise_power = 1;
  double depth_scale_m = 1;
};

/// A cloud and the plane of each of its points, 0 on a curved surface or none.
struct LabelledCloud {
  PointCloud cloud;
  std::vector<int> labels;
};

/// The cloud of solids from a sensor at the origin with the optical axis z.
LabelledCloud take_cloud(const std::vector<Solid>& solids, const CloudSensor& sensor,
                         Random& random);

/// The cloud of a random scene.
///
/// A room or an open space, 0.3 to 60 m, with boxes, cylinders, ellipsoids and heaps of small ones,
/// taken by a depth camera or a scanner with some kind of noise; partly through leaves, or moved
/// away from its viewpoint and mixed with points that fill a volume.
LabelledCloud random_cloud(Random& random);

}  // namespace synthetic
}  // namespace placegraph
