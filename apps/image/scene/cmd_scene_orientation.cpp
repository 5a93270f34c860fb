#include "apps/image/scene/cmd_scene_orientation.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/image/scene/scene_orientation.h"
#include "apps/support/calib_option.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_image_orientation_command(CLI::App& image) {
  auto arguments = std::make_shared<SceneOrientationArguments>();
  auto json = std::make_shared<bool>(false);
  SceneOrientationArguments& a = *arguments;
  CLI::App* command = image.add_subcommand(
      "orientation", "Estimate the orientation of the surface behind each pixel from edges");
  command->footer(
      "placegraph image orientation image.png --calib K.txt --out map.png --draw map_drawn.png");
  command->add_option("IMAGE", a.in, "an image, or a sequence: then --out and --draw are folders")
      ->required()
      ->check(CLI::ExistingPath);
  add_calib_option(*command, a.camera, kCalibFile);
  command
      ->add_option("-o,--out", a.out, "surfaces in the colours of their normals, with a legend")
      ->type_name(kOutput);
  command->add_flag("--ids", a.ids,
                    std::string(kIdsText) + ": 8 bits, 0 none, else 1 + axis of the normal");
  command
      ->add_option("--draw", a.drawing,
                   "PNG file, or folder for a sequence: the input, drawn with its surfaces")
      ->type_name(kOutput);
  command->add_option("--every", a.every, "use every n-th image")->capture_default_str();
  command
      ->add_option("--min-confidence", a.options.min_confidence,
                   "smallest confidence of a labelled pixel")
      ->capture_default_str();
  command
      ->add_option("--min-margin", a.options.min_margin,
                   "smallest margin of the best orientation over the second")
      ->capture_default_str();
  command->add_option("--seed", a.seed, kSeedText)->capture_default_str();
  command->add_flag("--json", *json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments, json] {
    const SceneOrientationResult result = scene_orientation(*arguments);
    print(*json ? to_json(result) : to_text(result));
    if (result.no_result) throw NoResult(*result.no_result);
  });
}

}  // namespace placegraph::apps
