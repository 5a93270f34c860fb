#pragma once
#include <placegraph/graph/measurements/point_cloud.h>

#include <functional>
#include <limits>

namespace placegraph::test {

/// An organised cloud of any size: `depth_at` gives the depth along a ray, not positive where
/// nothing is measured. The rays are 1/50 apart, about the middle of the image.
inline PointCloud small_cloud(int width, int height,
                              const std::function<double(double ray_x, double ray_y)>& depth_at) {
  constexpr double kFocal = 50;
  PointCloud cloud;
  cloud.width = width, cloud.height = height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Eigen::Vector3d ray((x - (width - 1) / 2.0) / kFocal, (y - (height - 1) / 2.0) / kFocal,
                                1);
      const double depth = depth_at(ray.x(), ray.y());
      cloud.points.push_back(
          depth > 0 ? Eigen::Vector3d(ray * depth)
                    : Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
    }
  return cloud;
}

}  // namespace placegraph::test
