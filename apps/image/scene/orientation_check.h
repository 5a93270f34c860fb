#pragma once
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <vector>

namespace placegraph::apps {

/// Counts of right pixels of orientation maps.
struct OrientationCheck {
  std::size_t judged = 0;    ///< pixels whose surface is known
  std::size_t oriented = 0;  ///< judged pixels with an orientation in the map
  std::size_t right = 0;     ///< judged pixels with the true orientation
  double coverage() const { return judged > 0 ? double(oriented) / double(judged) : 0; }
  double accuracy() const { return oriented > 0 ? double(right) / double(oriented) : 0; }
};

/// Compares an orientation map with the planes in an image and adds the counts to `check`.
/// The map `labels` is CV_8UC1: 0, or 1 + an axis, a column of `R_cam_manhattan`. `planes`
/// (CV_16UC1, 0 = none) are rows of `normals_world`, which `R_cam_world` rotates into the camera
/// frame. The right axis is the one nearest to the normal; for planes at more than 30 deg from all
/// axes no axis is right.
void check_orientation(const Image& labels, const Eigen::Matrix3d& R_cam_manhattan,
                       const Image& planes, const std::vector<Eigen::Vector3d>& normals_world,
                       const Eigen::Matrix3d& R_cam_world, OrientationCheck& check);

}  // namespace placegraph::apps
