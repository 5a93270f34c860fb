#include "apps/map/cmd_map.h"

#include <placegraph/pipeline/exports/map_export.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/map/cmd_map_import.h"
#include "apps/map/cmd_map_learn.h"
#include "apps/map/floor_planner.h"
#include "apps/map/map_info.h"
#include "apps/map/map_validate.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"

namespace placegraph::apps {
namespace {

/// Adds `map NAME MAP [--json]`, which prints the result of `run`, and returns it with its
/// arguments.
template <class Arguments, class Result>
std::pair<CLI::App*, Arguments*> add_report(CLI::App& map, const std::string& name,
                                            const char* what, Result (*run)(const Arguments&)) {
  auto arguments = std::make_shared<Arguments>();
  auto json = std::make_shared<bool>(false);
  CLI::App* command = map.add_subcommand(name, what);
  command->footer("placegraph map " + name + " out/town-run");
  command->add_option("MAP", arguments->map, kMapText)->type_name(kInput)->required();
  command->add_flag("--json", *json, kJsonText);
  command->callback([arguments, json, run] {
    const Result result = run(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
  return {command, arguments.get()};
}

/// Help of a form's option.
std::string help_of(const MapExportForm& form) {
  switch (form.target) {
    case MapExportTarget::kFile:
      break;
    case MapExportTarget::kFolder:
      return "folder for " + form.what;
    case MapExportTarget::kImage:
      return "name without .pgm and .yaml for " + form.what;
  }
  return "file for " + form.what;
}

void add_export_command(CLI::App& map) {
  auto arguments = std::make_shared<MapExportArguments>();
  CLI::App* command = map.add_subcommand("export", "Export parts of a saved map");
  command->footer("placegraph map export out/town-run --g2o graph.g2o --tum trajectory.tum");
  command->add_option("MAP", arguments->map, kMapText)->type_name(kInput)->required();
  const std::vector<MapExportForm> forms = map_export_forms();
  arguments->paths.resize(forms.size());
  for (std::size_t i = 0; i < forms.size(); ++i)
    command->add_option(forms[i].flag, arguments->paths[i], help_of(forms[i]))->type_name(kOutput);
  command->add_option("--component", arguments->component,
                      "component whose trajectory and geometry are written; default: the main one");
  command->add_flag("--ascii", arguments->ascii, "--ply, --colmap, --cloud and --mesh as text");
  command->add_option("--resolution", arguments->resolution_m, "side of a cell of --occupancy [m]")
      ->check(CLI::Range(0.001, 10.0))
      ->capture_default_str();
  command->add_flag("--walls", arguments->walls,
                    "--occupancy with the walls of the floor plan, from the images");
  command
      ->add_option("--voxel", arguments->voxel,
                   "side of the voxels of --cloud and --mesh, in the map's unit; default: 0.02 m "
                   "for depth images, else 1 % of the median depth of the landmarks")
      ->check(CLI::PositiveNumber);
  command->add_flag("--force", arguments->force, kForceText);
  arguments->floor_plan = floor_planner();
  command->callback([arguments] {
    std::optional<Progress> progress;
    const auto show = [&](std::size_t done, std::size_t total) {
      if (!progress) progress.emplace("dense depth", static_cast<std::int64_t>(total));
      progress->update(static_cast<std::int64_t>(done));
    };
    const MapExportResult result = map_export(*arguments, {messages(), show});
    progress.reset();
    print(to_text(result));
  });
}

}  // namespace

void add_map_commands(CLI::App& map) {
  const auto [info, arguments] = add_report(map, "info", "Summarize a saved map", map_info);
  info->add_flag("--list-places", arguments->places,
                 "list the places too: number, component, frame, keyframes, position, labels");
  add_report(map, "validate", "Check a saved map: every row, reference and number", map_validate);
  add_export_command(map);
  add_map_import_command(map);
  add_map_learn_command(map);
}

}  // namespace placegraph::apps
