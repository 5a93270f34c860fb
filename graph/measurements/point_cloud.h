#pragma once
#include <Eigen/Core>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Points of a scene in the sensor's frame [m].
/// They are from a depth camera, a scanner or a stereo pair. An organised cloud has a point for
/// every pixel of an image, row by row; a point is NaN if nothing was measured.
struct PointCloud {
  std::vector<Eigen::Vector3d> points;
  int width = 0, height = 0;  ///< [px] of an organised cloud, else 0
  double step_m = 0;          ///< depths are multiples of it; 0: not known, or too fine to matter

  bool organised() const { return width > 0 && height > 0; }
};

}  // namespace placegraph
