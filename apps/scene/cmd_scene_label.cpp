#include "apps/scene/cmd_scene_label.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/scene/cmd_scene_pictures.h"
#include "apps/scene/scene_label.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_scene_label_command(CLI::App& scene) {
  CLI::App* command =
      scene.add_subcommand("label", "What each pixel of a street is: road, building, car, ...");
  command->footer("placegraph scene label camvid/val --out labels");
  auto arguments = std::make_shared<ScenePictureArguments>();
  auto json = std::make_shared<bool>(false);
  add_scene_picture_options(*command, *arguments, *json);
  command->add_option("--surfaces-model", arguments->surfaces_model,
                      "the model of surfaces that is asked too");
  command->callback([arguments, json] {
    const ScenePictureResult result = scene_label(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
