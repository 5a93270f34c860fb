#include "apps/run/run_scene.h"

#include <placegraph/pipeline/map/map_floor_plan.h>
#include <placegraph/pipeline/results/floor_plan_files.h>
#include <placegraph/pipeline/results/semantic_map_files.h>

#include <nlohmann/json.hpp>

#include "apps/results/street_mapper.h"
#include "apps/support/output.h"

namespace placegraph::apps {

using nlohmann::json;

json map_rooms(const RunArguments& arguments, const RunOptions& options, const Dataset& dataset,
               RunResult& run) {
  const IndoorMap plan =
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
  check_urban_models(options.scene.urban,
                     {options.scene.urban_model, options.scene.surfaces_model});
}

json map_street(const RunArguments& arguments, const RunOptions& options, const Dataset& dataset,
                const RunResult& run) {
  const UrbanMapper mapper = street_mapper_of(
      run.map, run.calibration, dataset, run.sensor, run.lens_k1, options.scene.urban,
      {options.scene.urban_model, options.scene.surfaces_model});
  const SemanticMap semantic = mapper.fuse(run.map);
  if (semantic.outcome)
    write_semantic_map(arguments.out, semantic, mapper, run.map, poses_of(run.map), dataset.name(),
                       {}, messages());
  else
    warn("no semantic map: " + semantic.outcome.reason);
  return json::parse(semantic_map_json(semantic, mapper, run.map, dataset, arguments.sequence));
}

}  // namespace placegraph::apps
