#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <Eigen/Core>
#include <array>
#include <map>
#include <string>
#include <vector>

namespace placegraph {

/// A square marker that hangs or lies somewhere. Its frame: origin in the middle, x to the right
/// and y up as somebody reads it, z out of its face towards the reader.
struct PlacedMarker {
  int id = 0;         ///< in the layout's dictionary
  double side_m = 0;  ///< of the black square
  SE3 T_world_marker;

  /// Top left, top right, bottom right, bottom left, as somebody reads it.
  std::array<Eigen::Vector3d, 4> corners_marker() const {
    const double h = side_m / 2;
    return {{{-h, h, 0}, {h, h, 0}, {h, -h, 0}, {-h, -h, 0}}};
  }
};

/// What stands at known places of a room for a camera to find its position by.
struct MarkerLayout {
  std::string dictionary = "apriltag_36h11";  ///< one that MarkerDetector knows
  std::vector<PlacedMarker> markers;
  std::vector<Eigen::Vector3d> beacons_world;  ///< bright spots (LEDs), all alike [m]
  /// Sides [m] by id of markers whose place is not known: no position is found by them, but where
  /// they are can be mapped.
  std::map<int, double> unplaced_sides_m;
};

}  // namespace placegraph
