#include "apps/scene/cmd_scene.h"

#include <CLI/CLI.hpp>

#include "apps/scene/cmd_scene_check.h"
#include "apps/scene/cmd_scene_label.h"
#include "apps/scene/cmd_scene_orientation.h"
#include "apps/scene/cmd_scene_popup.h"
#include "apps/scene/cmd_scene_surfaces.h"

namespace placegraph::apps {

void add_scene_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("scene", "What a picture shows: surfaces and classes");
  command->footer("placegraph scene label camvid/val --out labels");
  command->require_subcommand(1);
  add_scene_check_command(*command);
  add_scene_label_command(*command);
  add_scene_orientation_command(*command);
  add_scene_popup_command(*command);
  add_scene_surfaces_command(*command);
}

}  // namespace placegraph::apps
