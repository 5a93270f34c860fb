#include "apps/run/run_scene.h"

#include <placegraph/pipeline/map/map_floor_plan.h>
#include <placegraph/pipeline/results/floor_plan_files.h>
#include <placegraph/pipeline/results/street_map_files.h>

#include <nlohmann/json.hpp>

#include "apps/results/street_mapper.h"
#include "apps/support/output.h"

namespace placegraph::apps {

using nlohmann::json;

json add_floor_plan(const RunArguments& arguments, const RunOptions& options,
                    const Dataset& dataset, RunResult& run) {
  const FloorPlan plan =
      plan_of_map(run.map, run.calibration, dataset, run.sensor, run.lens_k1, options.scene.indoor);
  if (plan.outcome) {
    label_places(plan, run.map.place_graph);
    save_labels(run_map_path(arguments.out), run.map.place_graph);
    write_floor_plan(arguments.out, plan, run.map, dataset.name(), messages());
    if (const auto doubt = doubt_of(plan)) warn(*doubt);
  } else {
    warn("no floor plan: " + plan.outcome.reason);
  }
  return json::parse(floor_plan_json(plan, run.map, dataset, arguments.sequence));
}

void check_street_models(const RunOptions& options) {
  check_street_map_models(options.scene.urban,
                          {options.scene.urban_model, options.scene.surfaces_model});
}

json add_street_map(const RunArguments& arguments, const RunOptions& options,
                    const Dataset& dataset, const RunResult& run) {
  const StreetMapper mapper = street_mapper_of(
      run.map, run.calibration, dataset, run.sensor, run.lens_k1, options.scene.urban,
      {options.scene.urban_model, options.scene.surfaces_model});
  const StreetMap semantic = mapper.fuse(run.map);
  if (semantic.outcome)
    write_street_map(arguments.out, semantic, mapper, run.map, poses_of(run.map), dataset.name(),
                     {}, messages());
  else
    warn("no street map: " + semantic.outcome.reason);
  return json::parse(street_map_json(semantic, mapper, run.map, dataset, arguments.sequence));
}

}  // namespace placegraph::apps
