#include "apps/map/map_plan.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/pipeline/map/map_file.h>
#include <placegraph/pipeline/map/map_floor_plan.h>
#include <placegraph/pipeline/results/floor_plan_files.h>

#include "apps/support/output.h"

namespace placegraph::apps {

MapPlanResult map_plan(const MapPlanArguments& arguments) {
  FloorPlanMapperOptions options;
  for (const std::string& setting : arguments.settings)
    set_option(options, setting, option_notes());
  options.check();
  require_free_folder(arguments.out, arguments.force);
  const StoredMap stored = read_stored_map(arguments.map, messages());
  if (!stored.origin.calibration || stored.map.keyframes.empty())
    throw NoResult(arguments.map + ": nothing in it has a pose");
  const auto dataset = open_dataset(stored.origin.sequence);
  const FloorPlan plan = plan_of_map(stored, options);
  if (!plan.outcome) throw NoResult(arguments.map + ": no floor plan: " + plan.outcome.reason);
  const OutputFolder folder(arguments.out);
  write_floor_plan(arguments.out, plan, stored.map, dataset->name(), messages());
  if (const auto doubt = doubt_of(plan)) warn(arguments.map + ": " + *doubt);
  return {
      arguments.map,
      arguments.out,
      plan.walls.size(),
      plan.doors.size(),
      plan.rooms.size(),
      nlohmann::json::parse(floor_plan_json(plan, stored.map, *dataset, stored.origin.sequence))};
}

std::string to_text(const MapPlanResult& result) {
  return fmt::format("{}: {} walls, {} doors, {} rooms; results in {}\n", result.map, result.walls,
                     result.doors, result.rooms, result.out);
}

std::string to_json(const MapPlanResult& result) { return json_text(result.summary, 1); }

}  // namespace placegraph::apps
