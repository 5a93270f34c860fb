#include "apps/map/cmd_map_import.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/map/map_import.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_map_import_command(CLI::App& map) {
  auto arguments = std::make_shared<MapImportArguments>();
  MapImportArguments& a = *arguments;
  CLI::App* command = map.add_subcommand("import", "Make a map of the model of another program");
  command->footer("placegraph map import --colmap model --images out/world --out imported.db");
  command->add_option("--colmap", a.colmap, "folder of a COLMAP model")
      ->type_name(kInput)
      ->required();
  command->add_option("--images", a.images, "the sequence of its images")
      ->type_name(kInput)
      ->required();
  command->add_option("-o,--out", a.out, "file for the map")->type_name(kOutput)->required();
  command->add_flag("--metric", a.metric, "lengths of the model are metres");
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments] { print(to_text(map_import(*arguments, messages()))); });
}

}  // namespace placegraph::apps
