#include "apps/scene/cmd_scene_pictures.h"

#include <CLI/CLI.hpp>

namespace placegraph::apps {

void add_scene_picture_options(CLI::App& command, ScenePictureArguments& a, bool& json) {
  command.add_option("INPUT", a.input, "an image, or a folder of them (or with them in images/)")
      ->required();
  command.add_option("--out", a.out, "folder for NAME.png, a class number a pixel")->required();
  command.add_option("--model", a.model, "in place of the one that came with the program");
  command
      .add_option("--unknown-below", a.unknown_below,
                  "less sure pixels get the number after the last class")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command.add_flag("--relations", a.relations,
                   "let the table of what lies above and beside what count too");
  command.add_flag("--confidence", a.confidence, "write NAME.confidence.png too, 255 = certain");
  command.add_flag("--draw", a.draw, "write NAME.drawn.png too, the classes in colours");
  command.add_option("--threads", a.threads, "pictures at a time")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command.add_flag("--json", json, "a report for machines");
  command.add_flag("--force", a.force, "write into a folder that is not empty");
}

}  // namespace placegraph::apps
