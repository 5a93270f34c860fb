#include "apps/cmd_scene.h"

#include <CLI/CLI.hpp>

#include "apps/cmd_scene_orientation.h"

namespace placegraph::apps {

void add_scene_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("scene", "The surfaces that an image shows");
  command->footer("placegraph scene orientation image.png --calib K.txt --out map.png");
  command->require_subcommand(1);
  add_scene_orientation_command(*command);
}

}  // namespace placegraph::apps
