#pragma once
#include <placegraph/graph/internal/scene/building_plan.h>
#include <placegraph/graph/scene/indoor_map.h>

#include <string>

namespace placegraph {

/// A plan as JSON (docs/indoor.md): walls, doors, rooms in plan coordinates [m]; without the cells.
std::string to_json(const IndoorMap& plan);

/// Reads what `to_json` writes. Throws FileError for what is no such file.
IndoorMap read_indoor_map(const std::string& path);

/// The true plan of a rendered building, as `placegraph synth` writes it (floorplan.json). Throws
/// FileError for a file that is missing or of another form.
BuildingPlan read_building_plan(const std::string& path);

}  // namespace placegraph
