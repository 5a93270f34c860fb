#include "apps/saved_map/cmd_map_semantic.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/saved_map/map_semantic.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_map_semantic_command(CLI::App& map) {
  auto arguments = std::make_shared<MapSemanticArguments>();
  auto json = std::make_shared<bool>(false);
  MapSemanticArguments& a = *arguments;
  CLI::App* command = map.add_subcommand("semantic", "What is where in the streets of a map.");
  command->footer("placegraph map semantic out/town --out out/town-semantic");
  command->add_option("MAP", a.map, "map.db, or the folder of placegraph run with it")->required();
  command->add_option("--out", a.out, "folder for semantic_map.ply, .json and .png")->required();
  command->add_option("--georeference", a.georeference,
                      "folder of placegraph georeference: the map is laid out east and north, and "
                      "semantic_map.geojson written");
  command->add_option("--model", a.models.urban, "another model of a street's classes");
  command->add_option("--surfaces-model", a.models.surfaces, "another model of surfaces");
  command->add_option("--set", a.settings, "one option of the map, key=value; may be repeated")
      ->allow_extra_args(false);
  command->add_flag("--json", *json, "for machines");
  command->add_flag("--force", a.force, "write into a folder that is not empty");
  command->callback([arguments, json] {
    const MapSemanticResult result = map_semantic(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
