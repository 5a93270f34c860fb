#include "apps/image/cmd_markers.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/image/markers_detect.h"
#include "apps/support/calib_option.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_markers_command(CLI::App& image) {
  auto arguments = std::make_shared<MarkersDetectArguments>();
  auto json = std::make_shared<bool>(false);
  MarkersDetectArguments& a = *arguments;
  CLI::App* command =
      image.add_subcommand("markers", "Detect square markers and estimate their poses");
  command->footer("placegraph image markers image.png --calib K.txt --side 0.2 --draw found.png");
  command
      ->add_option("IMAGE", a.image, "image")
      ->type_name(kInput)
      ->required();
  add_calib_option(*command, a.calib, kCalibFile)->required();
  auto* dictionary =
      command->add_option("--dictionary", a.dictionary, "apriltag_36h11, aruco_4x4_50, ...")
          ->capture_default_str();
  auto* side = command->add_option("--side", a.side_m, "side of the black square [m]")
                   ->check(CLI::PositiveNumber);
  command
      ->add_option(
          "--layout", a.layout,
          "layout of markers and beacons (markers.yaml); gives the pose of the camera in it")
      ->check(CLI::ExistingFile)
      ->excludes(dictionary)
      ->excludes(side);
  command
      ->add_option("--pixel-origin", a.origin,
                   "origin of pixel coordinates: centre or corner of the first pixel")
      ->check(CLI::IsMember(pixel_origin_names()))
      ->capture_default_str();
  command->add_option("-o,--out", a.out, "JSON file")->type_name(kOutput);
  command
      ->add_option("--draw", a.drawing, "PNG file for the image, drawn with its markers")
      ->type_name(kOutput);
  command->add_flag("--json", *json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments, json] {
    const MarkersDetectResult result = markers_detect(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
