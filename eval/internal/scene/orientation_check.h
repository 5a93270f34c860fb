#pragma once
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <vector>

namespace placegraph {

/// How many pixels of orientation maps are right.
struct OrientationCheck {
  std::size_t judged = 0;  ///< pixels whose surface is known
  std::size_t told = 0;    ///< of these, the map has an orientation
  std::size_t right = 0;   ///< of these, the true one
  double coverage() const { return judged > 0 ? double(told) / double(judged) : 0; }
  double accuracy() const { return told > 0 ? double(right) / double(told) : 0; }
};

/// Holds a map (CV_8UC1: 0 or 1 + an axis, columns of `R_cam_manhattan`) against the planes that
/// are seen: `planes` (CV_16UC1, 0 = none) are rows of `normals_world`, turned into the camera by
/// `R_cam_world`. Right is the axis that the normal is nearest to; planes turned by more than 30
/// deg from all axes are right under none. Adds to `check`.
void check_orientation(const Image& labels, const Eigen::Matrix3d& R_cam_manhattan,
                       const Image& planes, const std::vector<Eigen::Vector3d>& normals_world,
                       const Eigen::Matrix3d& R_cam_world, OrientationCheck& check);

}  // namespace placegraph
