#include "apps/image/scene/cmd_scene_surfaces.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/image/scene/cmd_scene_images.h"
#include "apps/image/scene/scene_surfaces.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_image_surfaces_command(CLI::App& image) {
  CLI::App* command = image.add_subcommand(
      "surfaces", "Label the pixels of an image: sky 0, ground 1, vertical 2, object 3");
  command->footer("placegraph image surfaces camvid/val --out surfaces");
  auto arguments = std::make_shared<SceneImageArguments>();
  auto json = std::make_shared<bool>(false);
  add_scene_image_options(*command, *arguments, *json);
  command->callback([arguments, json] {
    const SceneImageResult result = scene_surfaces(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
