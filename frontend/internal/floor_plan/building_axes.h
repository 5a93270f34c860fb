#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/scene/indoor_map.h>

#include <vector>

namespace placegraph {

/// How a building stands in the frame of its points.
struct BuildingAxes {
  Outcome outcome;  ///< degenerate: no level surface, no floor, or no upright surface
  /// Into the frame of the walls: x and y along two walls' normals, z up, floor at z = 0.
  SE3 T_walls_map;
  double ceiling_m = 0;  ///< of the highest level surface seen from below; 0: none
};

/// The vertical is the direction near `up_guess` that most level surfaces share, the floor the
/// lowest level that enough points lie on, the walls' turn the one modulo a right angle that most
/// upright surfaces share (robust means, each surface point by its normal). Points in map frame.
[[nodiscard]] BuildingAxes find_building_axes(const std::vector<SurfacePoint>& points_map,
                                              const Eigen::Vector3d& up_guess);

}  // namespace placegraph
