#pragma once
#include <placegraph/graph/scene/floor_plan.h>
#include <placegraph/graph/scene/true_floor_plan.h>

#include <string>

namespace placegraph {

/// A plan as JSON (docs/floor_plan.md): walls, doors, rooms in plan coordinates [m]; without the
/// cells.
std::string to_json(const FloorPlan& plan);

/// Reads the output of `to_json`. Throws FileError for any other file.
FloorPlan read_floor_plan(const std::string& path);

/// Reads the true plan of a rendered building, as written by `placegraph synth sequence`
/// (floorplan.json). Throws FileError for a file that is missing or in another format.
TrueFloorPlan read_true_floor_plan(const std::string& path);

}  // namespace placegraph
