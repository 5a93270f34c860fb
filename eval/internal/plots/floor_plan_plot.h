#pragma once
#include <placegraph/graph/internal/scene/building_plan.h>
#include <placegraph/graph/scene/indoor_map.h>

#include <string>

namespace placegraph {

struct FloorPlanPicture {
  std::string title;
  std::vector<Eigen::Vector2d> path;    ///< of the camera, plan coordinates
  const BuildingPlan* truth = nullptr;  ///< drawn below, if given; in plan coordinates
};

/// Rooms, walls, doors (open: a gap with its leaf's arc left out, closed: a bar), the camera's way
/// and a scale, x to the right and z up. Picture as SVG text or PNG bytes.
std::string floor_plan_svg(const IndoorMap& plan, const FloorPlanPicture& picture);
std::string floor_plan_png(const IndoorMap& plan, const FloorPlanPicture& picture);

}  // namespace placegraph
