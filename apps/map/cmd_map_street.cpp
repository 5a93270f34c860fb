#include "apps/map/cmd_map_street.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/map/map_street.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_map_street_command(CLI::App& map) {
  auto arguments = std::make_shared<MapStreetArguments>();
  auto json = std::make_shared<bool>(false);
  MapStreetArguments& a = *arguments;
  CLI::App* command = map.add_subcommand("street", "Make the street map of a map");
  command->footer("placegraph map street out/town-run --out out/town-street");
  command->add_option("MAP", a.map, kMapText)->type_name(kInput)->required();
  command->add_option("-o,--out", a.out, "folder for semantic_map.ply, .json and .png")
      ->type_name(kOutput)
      ->required();
  command
      ->add_option("--georeference", a.georeference,
                   "folder written by `placegraph map georeference`: use east-north-up axes and "
                   "write semantic_map.geojson")
      ->type_name(kInput);
  command->add_option("--model", a.models.urban, kModelText)->type_name(kInput);
  command
      ->add_option("--surfaces-model", a.models.surfaces,
                   "model of surfaces to use instead of the installed one")
      ->type_name(kInput);
  command->add_option("--set", a.settings, kSetText)->allow_extra_args(false);
  command->add_flag("--json", *json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments, json] {
    const MapStreetResult result = map_street(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
