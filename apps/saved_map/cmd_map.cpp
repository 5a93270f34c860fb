#include "apps/saved_map/cmd_map.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/saved_map/cmd_map_label.h"
#include "apps/saved_map/cmd_map_learn.h"
#include "apps/saved_map/cmd_map_plan.h"
#include "apps/saved_map/cmd_map_semantic.h"
#include "apps/saved_map/map_export.h"
#include "apps/saved_map/map_info.h"
#include "apps/saved_map/map_validate.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

const char* const kMapOrFolder = "map.db, or the folder of placegraph run with it";

/// `map NAME MAP [--json]`: prints what `run` finds in the map.
template <class Arguments, class Result>
void add_look(CLI::App& map, const std::string& name, const char* what,
              Result (*run)(const Arguments&)) {
  auto arguments = std::make_shared<Arguments>();
  auto json = std::make_shared<bool>(false);
  CLI::App* command = map.add_subcommand(name, what);
  command->footer("placegraph map " + name + " out/town");
  command->add_option("MAP", arguments->map, kMapOrFolder)->required();
  command->add_flag("--json", *json, "for machines");
  command->callback([arguments, json, run] {
    const Result result = run(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

void add_export_command(CLI::App& map) {
  auto arguments = std::make_shared<MapExportArguments>();
  CLI::App* command = map.add_subcommand("export", "Parts of a saved map as files of their own.");
  command->footer("placegraph map export out/town --g2o graph.g2o --tum trajectory.tum");
  command->add_option("MAP", arguments->map, kMapOrFolder)->required();
  const std::vector<MapExportForm> forms = map_export_forms();
  arguments->paths.resize(forms.size());
  for (std::size_t i = 0; i < forms.size(); ++i)
    command->add_option(forms[i].flag, arguments->paths[i], "file for " + forms[i].what);
  command->add_flag("--force", arguments->force, "overwrite files");
  command->callback([arguments] { map_export(*arguments); });
}

}  // namespace

void add_map_command(CLI::App& app) {
  CLI::App* map = app.add_subcommand("map", "Saved maps: learn, label, look at, check, export.");
  map->footer("placegraph map info out/town");
  map->require_subcommand(1);
  add_look(*map, "info", "What a saved map holds.", map_info);
  add_look(*map, "validate", "Whether a saved map is whole: every row, reference and number.",
           map_validate);
  add_export_command(*map);
  add_map_learn_command(*map);
  add_map_label_command(*map);
  add_map_plan_command(*map);
  add_map_semantic_command(*map);
}

}  // namespace placegraph::apps
