#include "apps/planes/cmd_planes_cloud.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/planes/planes_cloud.h"
#include "apps/support/calib_option.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_cloud_planes(CLI::App& planes) {
  auto arguments = std::make_shared<PlanesCloudArguments>();
  auto json = std::make_shared<bool>(false);
  PlanesCloudArguments& a = *arguments;
  planes
      .add_option("CLOUD", a.in,
                  "16-bit depth PNG, PLY (ascii, binary little endian), KITTI's .bin, or text with "
                  "x y z a line")
      ->check(CLI::ExistingFile);
  planes.add_option("-o,--out", a.out,
                    "plane of each pixel as 8-bit PNG, or of each point a line: 0 none, 1 the "
                    "largest");
  CLI::Option* cuboids = planes.add_option(
      "--cuboids", a.cuboids,
      "write boxes and rooms that planes at right angles make, as JSON; the cloud must have been "
      "taken from the origin");
  planes
      .add_option("--off-right-angle", a.cuboid_options.max_off_right_deg,
                  "of two of their faces, at most [deg]")
      ->needs(cuboids)
      ->capture_default_str();
  add_calib_option(planes, a.calib, std::string("camera of a depth image: ") + kCalibFile);
  planes
      .add_option("--depth-scale", a.depth_scale,
                  "metres a step of a depth image; from 1 up: steps a metre")
      ->capture_default_str();
  planes.add_option("--method", a.method, "how planes are found")
      ->check(CLI::IsMember(cloud_planes_method_names()))
      ->capture_default_str();
  planes.add_option("--flatness", a.options.flatness, "what a plane may bend, share of the depth")
      ->capture_default_str();
  planes.add_option("--min-points", a.options.min_points, "a plane with fewer is none")
      ->capture_default_str();
  planes.add_option("--model", a.model, "planarity as `train planarity` wrote it")
      ->check(CLI::ExistingFile);
  planes.add_option("--seed", a.options.seed, "of the random samples")->capture_default_str();
  planes.add_option("--gt", a.truth, "true labels, PNG or a line a point: judge what is found")
      ->check(CLI::ExistingFile);
  planes.add_option("--gt-min-points", a.check.min_points, "true planes with fewer do not count")
      ->capture_default_str();
  planes.add_option("--gt-same", a.same, "14=5: true label 14 counts as 5");
  planes.add_option("--gt-none", a.none, "true labels that are no plane");
  planes.add_flag("--json", *json, "print JSON");
  planes.add_flag("--force", a.force, "overwrite outputs");
  planes.callback([arguments, json, &planes] {
    if (!planes.get_subcommands().empty()) return;
    const PlanesCloudResult result = planes_cloud(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
