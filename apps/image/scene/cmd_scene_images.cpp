#include "apps/image/scene/cmd_scene_images.h"

#include <CLI/CLI.hpp>
#include "apps/support/option_texts.h"

namespace placegraph::apps {

void add_scene_image_options(CLI::App& command, SceneImageArguments& a, bool& json) {
  command
      .add_option("INPUT", a.input, "an image, or a folder of them (or with them in images/)")
      ->type_name(kInput)
      ->required();
  command
      .add_option("-o,--out", a.out,
                  "folder for NAME.png in the colours of the classes, with a legend")
      ->type_name(kOutput)
      ->required();
  command.add_option("--model", a.model, kModelText)->type_name(kInput);
  command
      .add_option("--unknown-below", a.unknown_below,
                  "pixels with a lower probability get the number after the last class")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command.add_flag("--relations", a.relations,
                   "use the table of spatial relations between classes");
  command.add_flag("--confidence", a.confidence, "also write NAME.confidence.png, 255 = certain");
  command.add_flag("--ids", a.ids, kIdsText);
  command.add_flag("--draw", a.draw, "as --ids, and write NAME.drawn.png in colours beside it");
  command.add_option("--threads", a.threads, kThreadsText)
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command.add_flag("--json", json, kJsonText);
  command.add_flag("--force", a.force, kForceText);
}

}  // namespace placegraph::apps
