#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/scene/floor_plan.h>

#include <vector>

namespace placegraph {

/// Orientation of a building in the frame of its points.
struct BuildingAxes {
  Outcome outcome;  ///< degenerate: no level surface, no floor, or no upright surface
  /// Transform into the frame of the walls: x and y along two walls' normals, z up, floor at z = 0.
  SE3 T_walls_map;
  double ceiling_m = 0;  ///< height of the highest level surface observed from below; 0: none
};

/// Estimates the vertical, the floor and the directions of the walls.
///
/// The vertical is the direction near `up_guess` that most level surfaces share; the floor is the
/// lowest level with enough points; the rotation of the walls, modulo a right angle, is that of
/// most upright surfaces (robust means, each surface point by its normal). Points in the map frame.
[[nodiscard]] BuildingAxes find_building_axes(const std::vector<SurfacePoint>& points_map,
                                              const Eigen::Vector3d& up_guess);

}  // namespace placegraph
