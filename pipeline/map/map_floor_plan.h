#pragma once
#include <placegraph/graph/map.h>
#include <placegraph/graph/scene/floor_plan.h>
#include <placegraph/io/datasets/dataset.h>
#include <placegraph/io/map/stored_map.h>
#include <placegraph/pipeline/scene/scene_map_options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// The floor plan of a map made from `dataset`; `lens_k1` is the distortion that was removed.
FloorPlan plan_of_map(const Map& map, const Calibration& calibration, const Dataset& dataset,
                      Sensor sensor, double lens_k1, const FloorPlanMapperOptions& options);

/// The same for a saved map, whose sequence is opened.
/// Throws FileError, and NoResult if nothing in the map has a pose.
FloorPlan plan_of_map(const StoredMap& stored, const FloorPlanMapperOptions& options = {});

/// Assigns each room's label to its places; other labels remain.
void label_places(const FloorPlan& plan, PlaceGraph& places);

}  // namespace placegraph
