#include "apps/image/scene/cmd_scene_label.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/image/scene/cmd_scene_images.h"
#include "apps/image/scene/scene_label.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_image_labels_command(CLI::App& image) {
  CLI::App* command = image.add_subcommand(
      "labels", "Classify the pixels of a street: road, building, car and others");
  command->footer("placegraph image labels camvid/val --out labels");
  auto arguments = std::make_shared<SceneImageArguments>();
  auto json = std::make_shared<bool>(false);
  add_scene_image_options(*command, *arguments, *json);
  command
      ->add_option("--surfaces-model", arguments->surfaces_model,
                   "model of surfaces to use instead of the installed one")
      ->type_name(kInput);
  command
      ->add_option("--surroundings", arguments->surroundings,
                   "where images may show no street, whose pixels then are unknown: `sequence` "
                   "judges it over neighbouring images, `each` image by image; `street`: every "
                   "image shows one")
      ->check(CLI::IsMember({"sequence", "each", "street"}))
      ->capture_default_str();
  command->callback([arguments, json] {
    const SceneImageResult result = scene_label(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
