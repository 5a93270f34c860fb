#pragma once
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/internal/core/random.h>
#include <placegraph/graph/internal/measurements/point_cloud.h>

#include <vector>

namespace placegraph::synthetic {

/// What a ray may hit, in a frame of its own, in whose unit it is a unit solid.
enum class SolidKind {
  kBox,       ///< |x|, |y|, |z| <= 1: six planes
  kRoom,      ///< the same from within
  kBall,      ///< |p| <= 1: scaled, an ellipsoid
  kCylinder,  ///< x^2 + y^2 <= 1, |z| <= 1: its two ends are planes
};

struct Solid {
  SolidKind kind = SolidKind::kBox;
  SE3 T_sensor_solid;
  Eigen::Vector3d half = Eigen::Vector3d::Ones();  ///< half its sides [m]
  int first_label = 1;  ///< of its planes, one after the other; curved faces have 0
};

/// How a cloud is taken.
struct CloudSensor {
  bool scans = false;  ///< even in azimuth and elevation, no image; otherwise a pinhole
  int width = 160, height = 120;
  double focal_px = 150;   ///< of the pinhole
  double step_rad = 0.01;  ///< of the scan
  double noise_share = 0;  ///< of the depth; power: see noise_power
  double noise_power = 1;  ///< deviation = noise_share * depth_scale * (depth / depth_scale)^power
  double depth_scale_m = 1;
};

/// A cloud and the plane of each of its points, 0 on a curved surface or none.
struct LabelledCloud {
  PointCloud cloud;
  std::vector<int> labels;
};

/// What a sensor at the origin that looks along z sees of solids.
LabelledCloud take_cloud(const std::vector<Solid>& solids, const CloudSensor& sensor,
                         Random& random);

/// A room or an open space of any size, 0.3 to 60 m, with boxes, cylinders, ellipsoids and heaps of
/// small ones, taken by a depth camera or a scanner with noise of some kind; partly through leaves,
/// or moved away from its viewpoint and mixed with points that fill a volume.
LabelledCloud random_cloud(Random& random);

}  // namespace placegraph::synthetic
