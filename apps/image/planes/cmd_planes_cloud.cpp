#include "apps/image/planes/cmd_planes_cloud.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/image/planes/planes_cloud.h"
#include "apps/support/calib_option.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

namespace {

void add_truth_options(CLI::App& planes, PlanesCloudArguments& a) {
  planes.add_option("--truth", a.truth, "true labels, PNG or one per line: evaluate the result")
      ->check(CLI::ExistingFile);
  planes
      .add_option("--truth-min-points", a.check.min_points,
                  "smallest number of points of a true plane")
      ->capture_default_str();
  planes.add_option("--truth-same", a.same, "true labels to merge, as 14=5");
  planes.add_option("--truth-none", a.none, "true labels that are not planes");
}

}  // namespace

void add_planes_command(CLI::App& image) {
  CLI::App& planes = *image.add_subcommand(
      "planes", "Find planes in a point cloud or depth image (short: planes)");
  planes.footer(
      "placegraph image planes depth.png --calib K.txt --depth-scale 0.001 --out planes.png");
  auto arguments = std::make_shared<PlanesCloudArguments>();
  auto json = std::make_shared<bool>(false);
  PlanesCloudArguments& a = *arguments;
  planes
      .add_option("CLOUD", a.in,
                  "16-bit depth PNG, PLY (ascii, binary little endian), KITTI's .bin, or text with "
                  "x y z a line")
      ->required()
      ->check(CLI::ExistingFile);
  planes
      .add_option("-o,--out", a.out,
                  "PNG in the colours of the planes, with a legend, or for a cloud the plane of "
                  "each point a line: 0 none, 1 the largest")
      ->type_name(kOutput);
  planes.add_flag("--ids", a.ids, std::string(kIdsText) + ": 8 bits, 16 from plane 256 on");
  CLI::Option* cuboids = planes.add_option(
      "--cuboids", a.cuboids,
      "JSON file for boxes and rooms of orthogonal planes; the cloud must have been taken from "
      "the origin");
  cuboids->type_name(kOutput);
  planes
      .add_option("--off-right-angle", a.cuboid_options.max_off_right_deg,
                  "largest deviation of two faces from a right angle [deg]")
      ->needs(cuboids)
      ->capture_default_str();
  add_calib_option(planes, a.calib, std::string("camera of a depth image: ") + kCalibFile);
  planes
      .add_option("--depth-scale", a.depth_scale,
                  "metres per step of a depth image; from 1 up: steps per metre")
      ->capture_default_str();
  planes.add_option("--method", a.method, "algorithm")
      ->check(CLI::IsMember(cloud_planes_method_names()))
      ->capture_default_str();
  planes
      .add_option("--flatness", a.options.flatness,
                  "largest deviation from a plane, as a share of the depth")
      ->capture_default_str();
  planes.add_option("--min-points", a.options.min_points, "smallest number of points of a plane")
      ->capture_default_str();
  planes.add_option("--model", a.model, "model written by `train planarity`")
      ->check(CLI::ExistingFile);
  planes.add_option("--seed", a.options.seed, kSeedText)->capture_default_str();
  add_truth_options(planes, a);
  planes.add_flag("--json", *json, kJsonText);
  planes.add_flag("--force", a.force, kForceText);
  planes.callback([arguments, json] {
    const PlanesCloudResult result = planes_cloud(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
