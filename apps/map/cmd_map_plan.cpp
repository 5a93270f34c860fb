#include "apps/map/cmd_map_plan.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/map/map_plan.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_map_plan_command(CLI::App& map) {
  auto arguments = std::make_shared<MapPlanArguments>();
  auto json = std::make_shared<bool>(false);
  MapPlanArguments& a = *arguments;
  CLI::App* command = map.add_subcommand("plan", "Draw the floor plan of an indoor map");
  command->footer("placegraph map plan out/office --out out/office-plan");
  command->add_option("MAP", a.map, kMapText)->type_name(kInput)->required();
  command->add_option("-o,--out", a.out, "folder for floor_plan.json, .svg and .png")
      ->type_name(kOutput)
      ->required();
  command->add_option("--set", a.settings, kSetText)->allow_extra_args(false);
  command->add_flag("--json", *json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments, json] {
    const MapPlanResult result = map_plan(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
