#pragma once
#include <placegraph/graph/scene/building_plan.h>
#include <placegraph/graph/scene/indoor_map.h>

#include <string>

namespace placegraph {

/// A plan as JSON (docs/indoor.md): walls, doors, rooms in plan coordinates [m]; without the cells.
std::string to_json(const IndoorMap& plan);

/// Reads the output of `to_json`. Throws FileError for any other file.
IndoorMap read_indoor_map(const std::string& path);

/// Reads the true plan of a rendered building, as written by `placegraph synth sequence`
/// (floorplan.json). Throws FileError for a file that is missing or in another format.
BuildingPlan read_building_plan(const std::string& path);

}  // namespace placegraph
