#pragma once
#include <placegraph/graph/internal/scene/building_plan.h>
#include <placegraph/graph/scene/indoor_map.h>

#include <string>

namespace placegraph {

struct FloorPlanPicture {
  std::string title;
  std::vector<Eigen::Vector2d> path;  ///< path of the camera, plan coordinates
  /// Ground truth in plan coordinates, drawn below; may be null.
  const BuildingPlan* truth = nullptr;
};

/// Draws rooms, walls, doors (open: a gap without the arc of the leaf, closed: a bar), the camera's
/// path and a scale bar, x to the right and z up. The picture is SVG text or PNG bytes.
std::string floor_plan_svg(const IndoorMap& plan, const FloorPlanPicture& picture);
std::string floor_plan_png(const IndoorMap& plan, const FloorPlanPicture& picture);

}  // namespace placegraph
