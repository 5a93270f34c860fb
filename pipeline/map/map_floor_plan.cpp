#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/pipeline/lens_correction.h>
#include <placegraph/pipeline/map/map_floor_plan.h>
#include <placegraph/pipeline/scene/floor_plan.h>

#include <algorithm>

namespace placegraph {

FloorPlan plan_of_map(const Map& map, const Calibration& calibration, const Dataset& dataset,
                      Sensor sensor, double lens_k1, const FloorPlanMapperOptions& options) {
  LensCorrection lens(dataset.calibration(sensor));
  if (lens_k1 != 0) lens.add(lens_k1);
  return map_floor_plan(
      map, calibration,
      [&](const Keyframe& keyframe) {
        Frame frame = dataset.frame(static_cast<std::size_t>(keyframe.frame.value()), sensor);
        if (lens_k1 != 0) lens.apply(frame);
        return frame;
      },
      options);
}

FloorPlan plan_of_map(const StoredMap& stored, const FloorPlanMapperOptions& options) {
  if (!stored.origin.calibration) throw NoResult("no floor plan: nothing in the map has a pose");
  const auto dataset = open_dataset(stored.origin.sequence);
  return plan_of_map(stored.map, *stored.origin.calibration, *dataset, stored.origin.sensor,
                     stored.origin.lens_k1, options);
}

void label_places(const FloorPlan& plan, PlaceGraph& places) {
  for (Place& place : places.places)
    for (const PlanRoom& room : plan.rooms)
      if (std::count(room.places.begin(), room.places.end(), place.id) &&
          !std::count(place.labels.begin(), place.labels.end(), room.label))
        place.labels.push_back(room.label);
}

}  // namespace placegraph
