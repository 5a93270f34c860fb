#include "apps/image/scene/cmd_scene.h"

#include <CLI/CLI.hpp>

#include "apps/eval/cmd_scene_check.h"
#include "apps/image/scene/cmd_scene_label.h"
#include "apps/image/scene/cmd_scene_orientation.h"
#include "apps/image/scene/cmd_scene_popup.h"
#include "apps/image/scene/cmd_scene_surfaces.h"

namespace placegraph::apps {

void add_scene_commands(CLI::App& image) {
  add_image_orientation_command(image);
  add_image_surfaces_command(image);
  add_image_labels_command(image);
  add_image_popup_command(image);
}

}  // namespace placegraph::apps
