#include "apps/image/scene/cmd_scene_popup.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/image/scene/scene_popup.h"
#include "apps/support/calib_option.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_image_popup_command(CLI::App& image) {
  CLI::App* command =
      image.add_subcommand("popup", "Make a 3D model of planes from one image, and insert a box");
  command->footer(
      "placegraph image popup street.png --calib K.txt --camera-height 1.65 --out street.ply");
  auto arguments = std::make_shared<ScenePopupArguments>();
  auto json = std::make_shared<bool>(false);
  ScenePopupArguments& a = *arguments;
  command
      ->add_option("IMAGE", a.image, "image, without distortion")
      ->type_name(kInput)
      ->required();
  command
      ->add_option("-o,--out", a.out, "file for the mesh, PLY, in the camera frame [m]")
      ->type_name(kOutput)
      ->required();
  add_calib_option(
      *command, a.calib,
      std::string("the camera: ") + kCalibFile + "; default: a lens of about 58 degrees");
  command->add_option("--camera-height", a.height_m, kCameraHeightText)
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--farthest", a.farthest_m, "distance of the farthest surface [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      ->add_option("--model", a.model, "model of surfaces to use instead of the installed one")
      ->type_name(kInput);
  command
      ->add_option("--surface-labels", a.surfaces,
                   "label image of `image surfaces` to use instead of the model")
      ->type_name(kInput);
  command->add_flag("--level-camera", a.level, "assume a level camera; ignore the edges");
  command->add_option("--box", a.box, "right,forward,width,depth,height [m] of a box on the ground")
      ->delimiter(',')
      ->expected(5);
  command
      ->add_option("--draw", a.draw,
                   "image file: the input with the box, hidden by nearer surfaces")
      ->type_name(kOutput);
  command
      ->add_option("--mask", a.mask, "image file: box visible (255), hidden (128)")
      ->type_name(kOutput);
  command->add_option("--seed", a.seed, kSeedText)->capture_default_str();
  command->add_flag("--json", *json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments, json] {
    const ScenePopupResult result = scene_popup(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
