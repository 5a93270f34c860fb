#include "apps/views/cmd_planes_cloud.h"

#include <fmt/format.h>
#include <placegraph/eval/scene/plane_check.h>
#include <placegraph/frontend/cloud_planes/cloud_planes.h>
#include <placegraph/frontend/cloud_planes/cuboids.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/measurements/point_cloud_file.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "apps/support/calib_option.h"
#include "apps/support/read_calib.h"
#include "apps/support/output.h"
#include "apps/support/usage.h"
#include "apps/views/planarity_file.h"

namespace placegraph::apps {
namespace {

using nlohmann::ordered_json;

const std::vector<std::string> kMethods = {"cuts", "ransac", "growing"};
constexpr int kMostLabels = 255;  ///< of an 8-bit image

struct PlanesCloudArguments {
  std::string in, out, cuboids, calibration, method = "cuts", model, truth;
  double depth_scale = 0.001;
  bool json = false, force = false;
  std::vector<std::string> same;
  std::vector<int> none;
  PlaneCheckOptions check;
  CloudPlanesOptions options;
  CuboidOptions cuboid_options;
};

bool is_image(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".png" || extension == ".pgm" || extension == ".tif" || extension == ".tiff";
}

PointCloud read_depth_cloud(const PlanesCloudArguments& arguments) {
  require(!arguments.calibration.empty(), "--calib: a depth image needs its camera");
  require(std::isfinite(arguments.depth_scale) && arguments.depth_scale > 0,
          "--depth-scale: " + std::to_string(arguments.depth_scale) + " is not above 0");
  // A step of a metre or more is none that a sensor has: then it is steps a metre.
  const double step_m =
      arguments.depth_scale < 1 ? arguments.depth_scale : 1 / arguments.depth_scale;
  const Camera camera =
      read_calib_without_distortion(arguments.calibration, "planes need a depth image and");
  const Image depth = read_depth(arguments.in, step_m);
  require_size(arguments.in, depth, camera.width, camera.height);
  return cloud_of_depth(depth, camera, step_m);
}

std::vector<int> read_truth(const PlanesCloudArguments& arguments, std::size_t points) {
  std::vector<int> labels;
  if (is_image(arguments.truth)) {
    const Image image = read_image_as_stored(arguments.truth);
    if (image.type() != CV_8UC1) throw FileError(arguments.truth, "not an 8-bit grey image");
    labels.assign(image.begin<unsigned char>(), image.end<unsigned char>());
  } else {
    labels = read_point_labels(arguments.truth);
  }
  if (labels.size() != points)
    throw FileError(arguments.truth, std::to_string(labels.size()) + " labels for " +
                                         std::to_string(points) + " points");
  for (const std::string& pair : arguments.same) {
    int a = 0, b = 0;
    char sign = 0, rest = 0;
    require(std::sscanf(pair.c_str(), "%d%c%d%c", &a, &sign, &b, &rest) == 3 && sign == '=',
            "--gt-same: " + pair + " is not of the form 14=5");
    std::replace(labels.begin(), labels.end(), a, b);
  }
  for (const int label : arguments.none) std::replace(labels.begin(), labels.end(), label, 0);
  return labels;
}

void write_labels(const PlanesCloudArguments& arguments, const PointCloud& cloud,
                  const std::vector<int>& labels) {
  if (!cloud.organised()) {
    std::string text;
    for (const int label : labels) text += std::to_string(label) + '\n';
    write_file(arguments.out, text);
    return;
  }
  Image image(cloud.height, cloud.width, CV_8UC1);
  std::transform(labels.begin(), labels.end(), image.begin<unsigned char>(), [](int label) {
    return static_cast<unsigned char>(label <= kMostLabels ? label : 0);
  });
  std::vector<unsigned char> bytes;
  cv::imencode(".png", image, bytes);
  write_file(arguments.out, std::string(bytes.begin(), bytes.end()));
}

ordered_json plane_json(int id, const CloudPlane& plane) {
  const Eigen::Vector3d& n = plane.plane.normal;
  ordered_json json;
  json["id"] = id;
  json["points"] = plane.points;
  json["normal"] = {n[0], n[1], n[2]};
  json["offset_m"] = plane.plane.distance_m;
  json["probability"] = plane.probability;
  json["chi2_per_dof"] = plane.chi2_per_dof;
  json["covariance"] = ordered_json::array();
  for (int row = 0; row < 3; ++row)
    for (int k = 0; k < 3; ++k) json["covariance"].push_back(plane.covariance(row, k));
  return json;
}

/// Boxes and rooms: middle and axes in the sensor's frame, sides, and the plane that each side is.
ordered_json cuboids_json(const std::vector<Cuboid>& cuboids) {
  ordered_json list = ordered_json::array();
  for (const Cuboid& cuboid : cuboids) {
    const Eigen::Vector3d& middle = cuboid.T_sensor_cuboid.translation();
    const Eigen::Matrix3d R = cuboid.T_sensor_cuboid.rotation().matrix();
    ordered_json one;
    one["kind"] = cuboid.kind == CuboidKind::kBox ? "box" : "room";
    one["middle_m"] = {middle[0], middle[1], middle[2]};
    one["size_m"] = {2 * cuboid.half[0], 2 * cuboid.half[1], 2 * cuboid.half[2]};
    one["R_sensor_cuboid"] = ordered_json::array();
    for (int row = 0; row < 3; ++row)
      one["R_sensor_cuboid"].push_back({R(row, 0), R(row, 1), R(row, 2)});
    constexpr const char* kSides[] = {"-x", "+x", "-y", "+y", "-z", "+z"};
    for (std::size_t side = 0; side < cuboid.faces.size(); ++side)
      if (cuboid.faces[side] >= 0) one["faces"][kSides[side]] = cuboid.faces[side] + 1;
    one["points"] = cuboid.points;
    list.push_back(one);
  }
  return list;
}

ordered_json check_json(const PlaneCheck& check) {
  return {{"planes", check.truth},
          {"correct", check.correct},
          {"correct_share", check.correct_share()},
          {"over_segmented", check.over_segmented},
          {"under_segmented", check.under_segmented},
          {"missed", check.missed},
          {"false", check.noise},
          {"extra_pieces", check.extra_pieces}};
}

void print(const PlanesCloudArguments& arguments, const PointCloud& cloud,
           const CloudPlanesResult& result, const ordered_json& check, const ordered_json& cuboids,
           double cpu_ms) {
  const auto on_planes = std::count_if(result.labels.begin(), result.labels.end(),
                                       [](int label) { return label > 0; });
  const auto measured = std::count_if(cloud.points.begin(), cloud.points.end(),
                                      [](const Eigen::Vector3d& p) { return p.allFinite(); });
  if (arguments.json) {
    ordered_json json;
    json["in"] = arguments.in;
    json["method"] = arguments.method;
    json["points"] = measured;
    json["on_planes"] = on_planes;
    json["noise"] = {{"at_1m_m", result.noise.at_1m},
                     {"power_of_depth", result.noise.power},
                     {"least_m", result.noise.least_m},
                     {"shared", result.noise.shared}};
    json["planes"] = ordered_json::array();
    for (std::size_t k = 0; k < result.planes.size(); ++k)
      json["planes"].push_back(plane_json(static_cast<int>(k) + 1, result.planes[k]));
    if (!check.is_null()) json["check"] = check;
    if (!cuboids.is_null()) json["cuboids"] = cuboids;
    json["cpu_ms"] = cpu_ms;
    std::puts(json.dump(2).c_str());
    return;
  }
  fmt::print("{}: {} points, {} planes, {} points on none\n", arguments.in, measured,
             result.planes.size(), measured - on_planes);
  for (std::size_t k = 0; k < result.planes.size(); ++k) {
    const CloudPlane& plane = result.planes[k];
    const Eigen::Vector3d& n = plane.plane.normal;
    fmt::print("  plane {}: {} points, normal ({:.3f}, {:.3f}, {:.3f}), offset {:.4g} m\n", k + 1,
               plane.points, n[0], n[1], n[2], plane.plane.distance_m);
  }
  if (!check.is_null())
    fmt::print("  of {} true planes: {} found, {} in pieces, {} missed; {} false\n",
               check["planes"].get<int>(), check["correct"].get<int>(),
               check["over_segmented"].get<int>(), check["missed"].get<int>(),
               check["false"].get<int>());
  if (!cuboids.is_null()) fmt::print("  {} boxes and rooms\n", cuboids.size());
  fmt::print("  {:.1f} ms CPU\n", cpu_ms);
}

void run(const PlanesCloudArguments& arguments) {
  require(!arguments.in.empty(), "planes: CLOUD or a subcommand is required");
  require(!arguments.out.empty(), "planes: --out is required");
  CloudPlanesOptions options = arguments.options;
  options.method = static_cast<CloudPlanesMethod>(
      std::find(kMethods.begin(), kMethods.end(), arguments.method) - kMethods.begin());
  options.check();
  arguments.cuboid_options.check();
  require_free(arguments.out, arguments.force);
  if (!arguments.cuboids.empty()) {
    require(arguments.cuboids != arguments.out, "--cuboids: the same file as --out");
    require_free(arguments.cuboids, arguments.force);
  }
  const PlanarityModel planarity =
      arguments.model.empty() ? built_in_planarity() : read_planarity(arguments.model);
  const PointCloud cloud =
      is_image(arguments.in) ? read_depth_cloud(arguments) : read_point_cloud(arguments.in);
  std::vector<int> truth;
  if (!arguments.truth.empty()) truth = read_truth(arguments, cloud.points.size());

  const Stopwatch watch;
  const CloudPlanesResult result = find_cloud_planes(cloud, options, planarity);
  const double cpu_ms = watch.cpu_ms();
  if (!result.outcome) throw FileError(arguments.in, result.outcome.reason);
  if (cloud.organised() && result.planes.size() > kMostLabels)
    warn(fmt::format("{} planes: an 8-bit image tells {} apart, the others are 0",
                     result.planes.size(), kMostLabels));
  ordered_json check, cuboids;
  if (!truth.empty()) check = check_json(check_planes(truth, result.labels, arguments.check));
  if (!arguments.cuboids.empty()) {
    if (!result.from_origin)
      throw FileError(arguments.in,
                      "--cuboids: not taken from the origin, which side of a plane "
                      "is seen is not known");
    cuboids = cuboids_json(find_cuboids(cloud, result, arguments.cuboid_options));
  }
  write_labels(arguments, cloud, result.labels);
  if (!arguments.cuboids.empty()) write_file(arguments.cuboids, cuboids.dump(2) + '\n');
  print(arguments, cloud, result, check, cuboids, cpu_ms);
}

}  // namespace

void add_cloud_planes(CLI::App& planes) {
  auto arguments = std::make_shared<PlanesCloudArguments>();
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
  add_calib_option(planes, a.calibration, std::string("camera of a depth image: ") + kCalibFile);
  planes
      .add_option("--depth-scale", a.depth_scale,
                  "metres a step of a depth image; from 1 up: steps a metre")
      ->capture_default_str();
  planes.add_option("--method", a.method, "how planes are found")
      ->check(CLI::IsMember(kMethods))
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
  planes.add_flag("--json", a.json, "print JSON");
  planes.add_flag("--force", a.force, "overwrite outputs");
  planes.callback([arguments, &planes] {
    if (planes.get_subcommands().empty()) run(*arguments);
  });
}

}  // namespace placegraph::apps
