#pragma once
#include <placegraph/graph/scene/floor_plan.h>
#include <placegraph/graph/scene/true_floor_plan.h>

#include <string>
#include <vector>

namespace placegraph {

struct FloorPlanPicture {
  std::string title;
  std::vector<Eigen::Vector2d> path;  ///< path of the camera, plan coordinates
  /// Ground truth in plan coordinates, drawn below; may be null.
  const TrueFloorPlan* truth = nullptr;
};

/// Rooms, walls, doors, the camera's path and a scale bar as SVG text, x to the right and z up.
/// A doorway has the sign of a door, an arc on the side of the larger room; the side of its hinges
/// is not observed. A closed door has a bar in it.
std::string floor_plan_svg(const FloorPlan& plan, const FloorPlanPicture& picture);

}  // namespace placegraph
