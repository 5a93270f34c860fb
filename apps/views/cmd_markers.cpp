#include "apps/views/cmd_markers.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/support/calib_option.h"
#include "apps/support/output.h"
#include "apps/views/markers_detect.h"

namespace placegraph::apps {

void add_markers_command(CLI::App& app) {
  CLI::App* markers = app.add_subcommand("markers", "Square markers of images");
  markers->footer("placegraph markers detect image.png --calib K.txt --side 0.2 --draw found.png");
  markers->require_subcommand(1);
  auto arguments = std::make_shared<MarkersDetectArguments>();
  auto json = std::make_shared<bool>(false);
  MarkersDetectArguments& a = *arguments;
  CLI::App* command = markers->add_subcommand(
      "detect", "Find markers: corners below a tenth of a pixel, both poses that explain them");
  command->footer("placegraph markers detect image.png --calib K.txt --side 0.2 --draw found.png");
  command->add_option("IMAGE", a.image, "image")->required();
  add_calib_option(*command, a.calib, kCalibFile, "--camera")->required();
  auto* dictionary =
      command->add_option("--dictionary", a.dictionary, "apriltag_36h11, aruco_4x4_50, ...")
          ->capture_default_str();
  auto* side = command->add_option("--side", a.side_m, "of the black square [m]")
                   ->check(CLI::PositiveNumber);
  command
      ->add_option("--layout", a.layout,
                   "markers.yaml: where markers and beacons are; gives the camera's pose there")
      ->check(CLI::ExistingFile)
      ->excludes(dictionary)
      ->excludes(side);
  command
      ->add_option("--pixel-origin", a.origin,
                   "of K and of the corners: the first pixel's centre, or its corner")
      ->check(CLI::IsMember(pixel_origin_names()))
      ->capture_default_str();
  command->add_option("-o,--out", a.out, "JSON file");
  command->add_option("--draw", a.drawing, "picture of them (PNG)");
  command->add_flag("--json", *json, "print JSON");
  command->add_flag("--force", a.force, "overwrite OUT and the drawing");
  command->callback([arguments, json] {
    const MarkersDetectResult result = markers_detect(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
