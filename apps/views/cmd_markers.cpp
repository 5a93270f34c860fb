#include "apps/views/cmd_markers.h"

#include <fmt/format.h>
#include <placegraph/frontend/markers/marker_dictionary.h>
#include <placegraph/frontend/markers/marker_filter.h>
#include <placegraph/frontend/markers/marker_pose.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/measurements/marker_layout_file.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/imgcodecs.hpp>

#include "apps/support/calib_option.h"
#include "apps/support/read_calib.h"
#include "apps/support/output.h"
#include "apps/support/usage.h"
#include "apps/views/draw_markers.h"

namespace placegraph::apps {
namespace {

using nlohmann::ordered_json;

struct MarkersArguments {
  std::string image, camera, layout, out, drawing, origin = "centre";
  std::string dictionary = MarkerLayout().dictionary;
  double side_m = 0;
  bool json = false, force = false;
  MarkerDetectorOptions options;

  /// How far their pixels lie from ours: those of an image whose corner is the origin have their
  /// centres at halves.
  double shift_px() const { return origin == "corner" ? 0.5 : 0; }
};

/// A marker and what it is known to be.
struct Found {
  MarkerSighting sighting;
  double side_m = 0;  ///< 0: not known
  MarkerPoses poses;
};

Camera camera_of(const MarkersArguments& arguments) {
  Camera camera = read_calib(arguments.camera);
  camera.cx -= arguments.shift_px();
  camera.cy -= arguments.shift_px();
  return camera;
}

double side_of(const MarkersArguments& arguments, const MarkerLayout& layout, int id) {
  for (const PlacedMarker& marker : layout.markers)
    if (marker.id == id) return marker.side_m;
  if (const auto unplaced = layout.unplaced_sides_m.find(id);
      unplaced != layout.unplaced_sides_m.end())
    return unplaced->second;
  return arguments.side_m;
}

ordered_json pose_json(const SE3& T, const Matrix6d& covariance) {
  ordered_json rows = ordered_json::array(), matrix = ordered_json::array();
  const Eigen::Matrix4d M = T.matrix();
  for (int i = 0; i < 4; ++i) rows.push_back({M(i, 0), M(i, 1), M(i, 2), M(i, 3)});
  for (int i = 0; i < 6; ++i) {
    ordered_json row = ordered_json::array();
    for (int j = 0; j < 6; ++j) row.push_back(covariance(i, j));
    matrix.push_back(row);
  }
  return {{"T", rows}, {"covariance", matrix}};
}

ordered_json found_json(const Found& found, double shift_px) {
  ordered_json corners = ordered_json::array(), sigmas = ordered_json::array();
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector2d& px = found.sighting.corners_px[k];
    corners.push_back({px.x() + shift_px, px.y() + shift_px});
    const Eigen::Vector2d sigma = found.sighting.corner_covariance(k).diagonal().cwiseSqrt();
    sigmas.push_back({sigma.x(), sigma.y()});
  }
  ordered_json json = {{"id", found.sighting.id},
                       {"corners_px", corners},
                       {"corner_sigma_px", sigmas},
                       {"side_m", nullptr},
                       {"poses", ordered_json::array()}};
  if (found.side_m > 0) json["side_m"] = found.side_m;
  for (const MarkerPose& pose : found.poses.poses) {
    ordered_json one = pose_json(pose.T_cam_marker, pose.covariance);
    one["chi2"] = pose.chi2;
    one["rms_px"] = pose.rms_px;
    json["poses"].push_back({{"T_cam_marker", one["T"]},
                             {"covariance", one["covariance"]},
                             {"chi2", one["chi2"]},
                             {"rms_px", one["rms_px"]}});
  }
  return json;
}

ordered_json report(const MarkersArguments& arguments, const std::vector<Found>& markers,
                    const MarkerAnswer& answer, double cpu_ms) {
  ordered_json json = {{"in", arguments.image},
                       {"dictionary", arguments.dictionary},
                       {"pixel_origin", arguments.origin},
                       {"markers", ordered_json::array()}};
  for (const Found& found : markers)
    json["markers"].push_back(found_json(found, arguments.shift_px()));
  if (!arguments.layout.empty()) {
    json["T_world_cam"] = nullptr;
    json["outcome"] = to_string(answer.outcome.code);
    if (answer.outcome) {
      const ordered_json pose = pose_json(answer.sighting.T_world_body, answer.sighting.covariance);
      json["T_world_cam"] = pose["T"];
      json["covariance"] = pose["covariance"];
    }
  }
  json["cpu_ms"] = cpu_ms;
  return json;
}

void print(const MarkersArguments& arguments, const std::vector<Found>& markers,
           const MarkerAnswer& answer, double cpu_ms) {
  fmt::print("{}: {} markers of {}\n", arguments.image, markers.size(), arguments.dictionary);
  for (const Found& found : markers) {
    fmt::print("  {:4d} ", found.sighting.id);
    for (const Eigen::Vector2d& px : found.sighting.corners_px)
      fmt::print(" ({:.2f}, {:.2f})", px.x() + arguments.shift_px(), px.y() + arguments.shift_px());
    fmt::print(" px\n");
    for (const MarkerPose& pose : found.poses.poses) {
      const Eigen::Vector3d& t = pose.T_cam_marker.translation();
      const Eigen::Vector3d w = pose.T_cam_marker.rotation().log() * (180 / std::numbers::pi);
      fmt::print(
          "        at {:.4f} {:.4f} {:.4f} m, turned by {:.2f} {:.2f} {:.2f} deg, chi2 {:.1f}\n",
          t.x(), t.y(), t.z(), w.x(), w.y(), w.z(), pose.chi2);
    }
  }
  if (!arguments.layout.empty()) {
    const Eigen::Vector3d& t = answer.sighting.T_world_body.translation();
    if (answer.outcome)
      fmt::print("  camera at {:.4f} {:.4f} {:.4f} m in the layout's world\n", t.x(), t.y(), t.z());
    else
      fmt::print("  no pose of the camera: {}\n", answer.outcome.reason);
  }
  fmt::print("  {:.1f} ms CPU\n", cpu_ms);
}

void draw(const MarkersArguments& arguments, const Image& grey, const std::vector<Found>& markers,
          const Camera& camera) {
  std::vector<DrawnMarker> drawn;
  for (const Found& found : markers) {
    drawn.push_back({found.sighting, std::nullopt, found.side_m});
    if (found.poses.outcome) drawn.back().T_cam_marker = found.poses.poses[0].T_cam_marker;
  }
  std::vector<unsigned char> png;
  cv::imencode(".png", draw_markers(grey, drawn, camera), png);
  write_file(arguments.drawing, std::string(png.begin(), png.end()));
}

void detect(MarkersArguments arguments) {
  require(std::isfinite(arguments.side_m), "--side: must be a finite number");
  for (const std::string& file : {arguments.out, arguments.drawing})
    if (!file.empty()) require_free(file, arguments.force);
  MarkerLayout layout;
  if (!arguments.layout.empty()) {
    layout = read_marker_layout(arguments.layout);
    arguments.dictionary = layout.dictionary;
  }
  const MarkerDetector detector(arguments.options, arguments.dictionary);
  const Camera camera = camera_of(arguments);
  const Image grey = read_image(arguments.image).grey;
  require_size(arguments.image, grey, camera.width, camera.height);

  const Stopwatch watch;
  MarkerView view;
  view.stamp_ns = 1;
  view.markers = detector.detect(grey, &camera);
  std::vector<Found> markers;
  for (const MarkerSighting& sighting : view.markers) {
    Found found{sighting, side_of(arguments, layout, sighting.id), {}};
    if (found.side_m > 0) found.poses = estimate_marker_poses(sighting, found.side_m, camera);
    markers.push_back(std::move(found));
  }
  MarkerAnswer answer;
  if (!arguments.layout.empty()) {
    if (!layout.beacons_world.empty()) view.beacons = detect_beacons(grey);
    if (!layout.markers.empty() || !layout.beacons_world.empty())
      answer = MarkerFilter({}, layout, camera, SE3()).observe(view);
    else
      answer.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                        "the layout gives no marker or beacon its place");
  }
  const double cpu_ms = watch.cpu_ms();
  if (markers.empty() && !answer.outcome)
    throw NoAnswer(arguments.image + ": no marker of " + arguments.dictionary);
  const ordered_json json = report(arguments, markers, answer, cpu_ms);
  if (!arguments.out.empty()) write_file(arguments.out, json.dump(2) + "\n");
  if (!arguments.drawing.empty()) draw(arguments, grey, markers, camera);
  if (arguments.json)
    std::puts(json.dump(2).c_str());
  else
    print(arguments, markers, answer, cpu_ms);
}

}  // namespace

void add_markers_command(CLI::App& app) {
  CLI::App* markers = app.add_subcommand("markers", "Square markers of images");
  markers->footer("placegraph markers detect image.png --calib K.txt --side 0.2 --draw found.png");
  markers->require_subcommand(1);
  auto arguments = std::make_shared<MarkersArguments>();
  MarkersArguments& a = *arguments;
  CLI::App* command = markers->add_subcommand(
      "detect", "Find markers: corners below a tenth of a pixel, both poses that explain them");
  command->footer("placegraph markers detect image.png --calib K.txt --side 0.2 --draw found.png");
  command->add_option("IMAGE", a.image, "image")->required();
  add_calib_option(*command, a.camera, kCalibFile, "--camera")->required();
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
      ->check(CLI::IsMember({"centre", "corner"}))
      ->capture_default_str();
  command->add_option("-o,--out", a.out, "JSON file");
  command->add_option("--draw", a.drawing, "picture of them (PNG)");
  command->add_flag("--json", a.json, "print JSON");
  command->add_flag("--force", a.force, "overwrite OUT and the drawing");
  command->callback([arguments] { detect(*arguments); });
}

}  // namespace placegraph::apps
