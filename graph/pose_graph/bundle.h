#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A camera of a bundle: pinhole with radial distortion, principal point at zero,
/// px = f (1 + k1 s + k2 s^2) q with q = [x/z, y/z], s = |q|^2 (x right, y down, z forward).
struct BundleCamera {
  SE3 T_world_cam;
  double focal_px = 1, k1 = 0, k2 = 0;
};

/// A point seen in a camera.
struct BundleObservation {
  int camera = 0, point = 0;  ///< positions in Bundle::cameras and Bundle::points
  Eigen::Vector2d px = Eigen::Vector2d::Zero();  ///< from the principal point
};

/// Cameras, points and who sees what: a bundle-adjustment problem, its start or its solution.
struct Bundle {
  std::vector<BundleCamera> cameras;
  std::vector<Eigen::Vector3d> points;  ///< in the world
  std::vector<BundleObservation> observations;

  /// Throws ArgumentError: an observation of a camera or point that is not there, a focal length
  /// that is not positive, anything that is not finite.
  void check() const;
};

}  // namespace placegraph
