#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <array>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A camera of a bundle: pinhole with radial distortion, principal point at zero.
/// px = f (1 + k1 s + k2 s^2) q with q = [x/z, y/z], s = |q|^2 (x right, y down, z forward).
struct BundleCamera {
  SE3 T_world_cam;                      ///< pose
  double focal_px = 1, k1 = 0, k2 = 0;  ///< focal length and coefficients of radial distortion
  /// The numbers of the BAL file that it was read from, which are written again while they give
  /// this camera: a rotation vector is not unique.
  std::optional<std::array<double, 9>> of_file = std::nullopt;
};

/// The observation of a point in a camera.
struct BundleObservation {
  int camera = 0, point = 0;  ///< positions in Bundle::cameras and Bundle::points
  Eigen::Vector2d px = Eigen::Vector2d::Zero();  ///< position relative to the principal point [px]
};

/// A problem of bundle adjustment: cameras, points and observations.
/// Cameras and points are an initialization or a solution.
struct Bundle {
  std::vector<BundleCamera> cameras;            ///< with intrinsics of their own
  std::vector<Eigen::Vector3d> points;          ///< in the world frame
  std::vector<BundleObservation> observations;  ///< in any order

  /// Throws ArgumentError naming the first entry that is invalid.
  /// Invalid are an observation of an unknown camera or point, a focal length that is not positive,
  /// and values that are not finite.
  void check() const;
};

}  // namespace placegraph
