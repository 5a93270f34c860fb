#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <Eigen/Core>
#include <array>
#include <map>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A square marker at a known pose.
/// Its frame: origin in the middle, x to the right and y up for a viewer in front of it, z out of
/// its face towards the viewer.
struct PlacedMarker {
  int id = 0;         ///< id in the layout's dictionary
  double side_m = 0;  ///< side of the black square [m]
  SE3 T_world_marker;

  /// Top left, top right, bottom right, bottom left, for a viewer in front of it.
  std::array<Eigen::Vector3d, 4> corners_marker() const {
    const double h = side_m / 2;
    return {{{-h, h, 0}, {h, h, 0}, {h, -h, 0}, {-h, -h, 0}}};
  }
};

/// Markers and beacons at known positions of a room, for the localization of a camera.
struct MarkerLayout {
  std::string dictionary = "apriltag_36h11";  ///< a dictionary of MarkerDetector
  std::vector<PlacedMarker> markers;
  std::vector<Eigen::Vector3d> beacons_world;  ///< bright spots (LEDs), indistinguishable [m]
  /// Sides [m], by id, of markers with unknown pose: they do not localize the camera, but their
  /// poses can be mapped.
  std::map<int, double> unplaced_sides_m;
};

}  // namespace placegraph
