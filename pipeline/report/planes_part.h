#pragma once
#include <placegraph/graph/scene/floor_plan.h>

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace placegraph::report {

/// floor_plan.json in the folder of a run; nothing where there is none. Throws FileError.
std::optional<FloorPlan> floor_plan_in(const std::string& folder);

/// The direction up in the map, against y of a plan.
nlohmann::json up_of_plan(const SO3& R_plan_map);

/// Walls, doors and rooms as polylines in the plan.
nlohmann::json describe_floor_plan(const FloorPlan& plan);

/// The surfaces of the plan as polygons in the map: walls between the heights at which they were
/// observed, doors up to their heads, floors of the rooms.
nlohmann::json describe_planes(const FloorPlan& plan);

}  // namespace placegraph::report
