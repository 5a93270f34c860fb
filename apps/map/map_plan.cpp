#include "apps/map/map_plan.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/datasets/open_dataset.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/results/floor_plan_files.h"
#include "apps/results/map_file.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

struct MapPlanArguments {
  std::string map, out;
  std::vector<std::string> settings;
  bool as_json = false, force = false;
};

void draw_plan(const MapPlanArguments& arguments) {
  IndoorMapperOptions options;
  for (const std::string& setting : arguments.settings) set_option(options, setting);
  options.check();
  require_free_folder(arguments.out, arguments.force);
  const StoredMap stored = read_stored_map(arguments.map);
  if (!stored.origin.calibration || stored.map.keyframes.empty())
    throw NoAnswer(arguments.map + ": nothing in it has a pose");
  const auto dataset = open_dataset(stored.origin.sequence);
  const IndoorMap plan = plan_of_map(stored.map, *stored.origin.calibration, *dataset,
                                     stored.origin.sensor, stored.origin.lens_k1, options);
  if (!plan.outcome) throw NoAnswer(arguments.map + ": no floor plan: " + plan.outcome.reason);
  const OutputFolder folder(arguments.out);
  write_floor_plan(arguments.out, plan, stored.map, dataset->name());
  const nlohmann::json summary =
      describe_floor_plan(plan, stored.map, *dataset, stored.origin.sequence);
  if (arguments.as_json)
    fmt::print("{}\n", summary.dump(1));
  else
    fmt::print("{}: {} walls, {} doors, {} rooms; results in {}\n", arguments.map,
               plan.walls.size(), plan.doors.size(), plan.rooms.size(), arguments.out);
}

}  // namespace

void add_map_plan_command(CLI::App& map) {
  auto arguments = std::make_shared<MapPlanArguments>();
  MapPlanArguments& a = *arguments;
  CLI::App* command = map.add_subcommand("plan", "Draws the floor plan of an indoor map.");
  command->footer("placegraph map plan out/office --out out/office-plan");
  command->add_option("MAP", a.map, "map.db, or the folder of placegraph run with it")->required();
  command->add_option("--out", a.out, "folder for floor_plan.json, .svg and .png")->required();
  command->add_option("--set", a.settings, "one option of the plan, key=value; may be repeated")
      ->allow_extra_args(false);
  command->add_flag("--json", a.as_json, "for machines");
  command->add_flag("--force", a.force, "write into a folder that is not empty");
  command->callback([arguments] { draw_plan(*arguments); });
}

}  // namespace placegraph::apps
