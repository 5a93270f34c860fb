#include "apps/scene/cmd_scene_popup.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/scene/scene_popup.h"
#include "apps/support/calib_option.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_scene_popup_command(CLI::App& scene) {
  CLI::App* command =
      scene.add_subcommand("popup", "Fold a picture up into space, and put a box into it");
  command->footer(
      "placegraph scene popup street.png --calib K.txt --camera-height 1.65 --out street.ply --box "
      "1,12,0.6,0.6,1.8 --draw overlay.png");
  auto arguments = std::make_shared<ScenePopupArguments>();
  auto json = std::make_shared<bool>(false);
  ScenePopupArguments& a = *arguments;
  command->add_option("IMAGE", a.image, "image, without distortion")->required();
  command->add_option("--out", a.out, "write the mesh, PLY, in metres of the camera's frame")
      ->required();
  add_calib_option(*command, a.calib,
                   std::string("the camera: ") + kCalibFile + "; else a usual one is supposed");
  command->add_option("--camera-height", a.height_m, "above the ground [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--farthest", a.farthest_m, "nothing but the sky is farther [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--model", a.model,
                      "of surfaces, in place of the one that came with the program");
  command->add_option("--surfaces", a.surfaces,
                      "label image of `scene surfaces` to take instead of the model's");
  command->add_flag("--level", a.level, "the camera is level: do not ask the edges");
  command->add_option("--box", a.box, "right,forward,width,depth,height [m] of a box on the ground")
      ->delimiter(',')
      ->expected(5);
  command->add_option("--draw", a.draw,
                      "write the picture with the box in it, behind what is nearer");
  command->add_option("--mask", a.mask, "write where the box is seen (255) and hidden (128)");
  command->add_option("--seed", a.seed, "of the search for vanishing points")
      ->capture_default_str();
  command->add_flag("--json", *json, "a report for machines");
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments, json] {
    const ScenePopupResult result = scene_popup(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
