#include "apps/run/run_scene.h"

#include <placegraph/pipeline/map/map_floor_plan.h>

#include <nlohmann/json.hpp>

#include "apps/results/floor_plan_files.h"
#include "apps/results/run_map.h"
#include "apps/results/semantic_map_files.h"
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
    write_floor_plan(arguments.out, plan, run.map, dataset.name());
    if (const auto doubt = doubt_of(plan)) warn(*doubt);
  } else {
    warn("no floor plan: " + plan.outcome.reason);
  }
  return describe_floor_plan(plan, run.map, dataset, arguments.sequence);
}

void check_street_models(const RunOptions& options) {
  check_urban_models(options.scene.urban,
                     {options.scene.urban_model, options.scene.surfaces_model});
}

json map_street(const RunArguments& arguments, const RunOptions& options, const Dataset& dataset,
                const RunResult& run) {
  const UrbanMapper mapper = urban_mapper_of(
      run.map, run.calibration, dataset, run.sensor, run.lens_k1, options.scene.urban,
      {options.scene.urban_model, options.scene.surfaces_model});
  const SemanticMap semantic = mapper.fuse(run.map);
  if (semantic.outcome)
    write_semantic_map(arguments.out, semantic, mapper, run.map, poses_of(run.map), dataset.name());
  else
    warn("no semantic map: " + semantic.outcome.reason);
  return describe_semantic_map(semantic, mapper, run.map, dataset, arguments.sequence);
}

}  // namespace placegraph::apps
