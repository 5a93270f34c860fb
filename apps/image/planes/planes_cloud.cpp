#include "apps/image/planes/planes_cloud.h"

#include <fmt/format.h>
#include <placegraph/eval/drawing/picture_bytes.h>
#include <placegraph/eval/drawing/picture_legend.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/picture_file.h>
#include <placegraph/io/measurements/point_cloud_file.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/image/planes/planarity_file.h"
#include "apps/support/choice.h"
#include "apps/support/output.h"
#include "apps/support/read_calib.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

using nlohmann::ordered_json;

bool is_image(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".png" || extension == ".pgm" || extension == ".tif" || extension == ".tiff";
}

PointCloud read_depth_cloud(const PlanesCloudArguments& arguments) {
  require(!arguments.calib.empty(), "--calib: a depth image needs its camera");
  require(std::isfinite(arguments.depth_scale) && arguments.depth_scale > 0,
          "--depth-scale: " + std::to_string(arguments.depth_scale) + " is not above 0");
  // No sensor has steps of a metre or more: such a value means steps per metre.
  const double step_m =
      arguments.depth_scale < 1 ? arguments.depth_scale : 1 / arguments.depth_scale;
  const Camera camera =
      read_calib_without_distortion(arguments.calib, "planes need a depth image and");
  const Image depth = read_depth(arguments.in, step_m);
  require_size(arguments.in, depth, camera.width, camera.height);
  return cloud_of_depth(depth, camera, step_m);
}

std::vector<int> read_truth(const PlanesCloudArguments& arguments, std::size_t points) {
  std::vector<int> labels;
  if (is_image(arguments.truth)) {
    const Image image = read_image_as_stored(arguments.truth);
    if (image.type() != CV_8UC1 && image.type() != CV_16UC1)
      throw FileError(arguments.truth, "no grey image of 8 or 16 bits (--ids writes one)");
    Image numbers;
    image.convertTo(numbers, CV_32S);
    labels.assign(numbers.begin<int>(), numbers.end<int>());
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
            "--truth-same: " + pair + " is not of the form 14=5");
    std::replace(labels.begin(), labels.end(), a, b);
  }
  for (const int label : arguments.none) std::replace(labels.begin(), labels.end(), label, 0);
  return labels;
}

/// The pixels in the colours of their planes, grey where there is none, and the largest planes in a
/// legend.
Image draw_planes(const Image& numbers, const std::vector<CloudPlane>& planes,
                  const std::string& wanted) {
  constexpr int kNone = 225;
  Image drawing(numbers.size(), CV_8UC3);
  for (int v = 0; v < numbers.rows; ++v)
    for (int u = 0; u < numbers.cols; ++u) {
      const int plane = numbers.at<int>(v, u);
      const Colour c = plane > 0 ? area_colour(static_cast<std::size_t>(plane - 1))
                                 : Colour{kNone, kNone, kNone};
      drawing.at<cv::Vec3b>(v, u) = cv::Vec3b(
          static_cast<uchar>(c.blue), static_cast<uchar>(c.green), static_cast<uchar>(c.red));
    }
  std::vector<LegendEntry> legend;
  constexpr std::size_t kListed = 12;
  for (std::size_t k = 0; k < std::min(planes.size(), kListed); ++k)
    legend.push_back(
        area_entry(fmt::format("plane {}: {} points", k + 1, planes[k].points), area_colour(k)));
  if (planes.size() > kListed)
    legend.push_back(
        area_entry(fmt::format("{} smaller planes", planes.size() - kListed), {255, 255, 255}));
  legend.push_back(area_entry("no plane, or no depth", {kNone, kNone, kNone}));
  return with_legend(drawing, legend, wanted);
}

void write_labels(const PlanesCloudArguments& arguments, const PointCloud& cloud,
                  const CloudPlanesResult& found) {
  const std::vector<int>& labels = found.labels;
  if (!cloud.organised()) {
    std::string text;
    for (const int label : labels) text += std::to_string(label) + '\n';
    write_file(arguments.out, text);
    return;
  }
  const Image numbers(cloud.height, cloud.width, CV_32SC1, const_cast<int*>(labels.data()));
  if (arguments.ids) {
    Image ids;  // 65535 planes are more than an image has room for
    numbers.convertTo(ids, found.planes.size() > 255 ? CV_16U : CV_8U);
    write_png(arguments.out, ids);
  } else {
    write_png(arguments.out, draw_planes(numbers, found.planes, arguments.out));
  }
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

/// Boxes and rooms: centre and axes in the sensor's frame, sides, and the plane of each side.
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

/// Checks the arguments and returns the options with their method.
CloudPlanesOptions checked_options(const PlanesCloudArguments& arguments) {
  require(!arguments.in.empty(), "planes: CLOUD or a subcommand is required");
  require(!arguments.out.empty(), "planes: --out is required");
  CloudPlanesOptions options = arguments.options;
  options.method =
      choice<CloudPlanesMethod>("--method", cloud_planes_method_names(), arguments.method);
  options.check();
  arguments.cuboid_options.check();
  require_free(arguments.out, arguments.force);
  if (is_image(arguments.in) && !arguments.ids) require_drawings(arguments.out);
  if (!arguments.cuboids.empty()) require_free(arguments.cuboids, arguments.force);
  return options;
}

std::vector<Cuboid> cuboids_of(const PlanesCloudArguments& arguments, const PointCloud& cloud,
                               const CloudPlanesResult& found) {
  if (!found.from_origin)
    throw FileError(
        arguments.in,
        "--cuboids: the cloud was not taken from the origin, so the visible side of a plane "
        "is seen is not known");
  return find_cuboids(cloud, found, arguments.cuboid_options);
}

}  // namespace

const std::vector<std::string>& cloud_planes_method_names() {
  static const std::vector<std::string> names = {"cuts", "ransac", "growing"};
  return names;
}

PlanesCloudResult planes_cloud(const PlanesCloudArguments& arguments) {
  const CloudPlanesOptions options = checked_options(arguments);
  const PlanarityModel planarity =
      arguments.model.empty() ? built_in_planarity() : read_planarity(arguments.model);
  const PointCloud cloud =
      is_image(arguments.in) ? read_depth_cloud(arguments) : read_point_cloud(arguments.in);
  std::vector<int> truth;
  if (!arguments.truth.empty()) truth = read_truth(arguments, cloud.points.size());

  PlanesCloudResult result;
  result.in = arguments.in;
  result.method = arguments.method;
  const Stopwatch watch;
  result.found = find_cloud_planes(cloud, options, planarity);
  result.cpu_ms = watch.cpu_ms();
  const CloudPlanesResult& found = result.found;
  if (!found.outcome) throw FileError(arguments.in, found.outcome.reason);
  result.points = std::count_if(cloud.points.begin(), cloud.points.end(),
                                [](const Eigen::Vector3d& p) { return p.allFinite(); });
  result.on_planes =
      std::count_if(found.labels.begin(), found.labels.end(), [](int label) { return label > 0; });
  if (!truth.empty()) result.check = check_planes(truth, found.labels, arguments.check);
  if (!arguments.cuboids.empty()) result.cuboids = cuboids_of(arguments, cloud, found);
  write_labels(arguments, cloud, found);
  if (result.cuboids) write_file(arguments.cuboids, json_text(cuboids_json(*result.cuboids), 2));
  return result;
}

std::string to_text(const PlanesCloudResult& result) {
  const std::vector<CloudPlane>& planes = result.found.planes;
  std::string text = fmt::format("{}: {} points, {} planes, {} points on none\n", result.in,
                                 result.points, planes.size(), result.points - result.on_planes);
  constexpr std::size_t kListed = 10;  // a room has some ten; --out and --json have all
  for (std::size_t k = 0; k < std::min(planes.size(), kListed); ++k) {
    const Eigen::Vector3d& n = planes[k].plane.normal;
    text += fmt::format("  plane {}: {} points, normal ({:.3f}, {:.3f}, {:.3f}), offset {:.4g} m\n",
                        k + 1, planes[k].points, n[0], n[1], n[2], planes[k].plane.distance_m);
  }
  if (planes.size() > kListed)
    text += fmt::format("  {} more, of at most {} points (--json lists all)\n",
                        planes.size() - kListed, planes[kListed].points);
  if (const auto& check = result.check)
    text += fmt::format("  of {} true planes: {} found, {} in pieces, {} missed; {} false\n",
                        check->truth, check->correct, check->over_segmented, check->missed,
                        check->noise);
  if (result.cuboids) text += fmt::format("  {} boxes and rooms\n", result.cuboids->size());
  return text + fmt::format("  {:.1f} ms CPU\n", result.cpu_ms);
}

std::string to_json(const PlanesCloudResult& result) {
  const CloudPlanesResult& found = result.found;
  ordered_json json;
  json["in"] = result.in;
  json["method"] = result.method;
  json["points"] = result.points;
  json["on_planes"] = result.on_planes;
  json["noise"] = {{"at_1m_m", found.noise.at_1m},
                   {"power_of_depth", found.noise.power},
                   {"least_m", found.noise.least_m},
                   {"shared", found.noise.shared}};
  json["planes"] = ordered_json::array();
  for (std::size_t k = 0; k < found.planes.size(); ++k)
    json["planes"].push_back(plane_json(static_cast<int>(k) + 1, found.planes[k]));
  if (result.check) json["check"] = check_json(*result.check);
  if (result.cuboids) json["cuboids"] = cuboids_json(*result.cuboids);
  json["cpu_ms"] = result.cpu_ms;
  return json_text(json, 2);
}

}  // namespace placegraph::apps
