#include "apps/image/markers_detect.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/calibration/read_calibration.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/picture_file.h>
#include <placegraph/io/measurements/marker_layout_file.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/image/draw_markers.h"
#include "apps/support/choice.h"
#include "apps/support/numbers_json.h"
#include "apps/support/output.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

using nlohmann::ordered_json;

enum class PixelOrigin { kCentre, kCorner };

/// The camera with its principal point relative to the first pixel's centre.
Camera camera_of(const MarkersDetectArguments& arguments) {
  const auto origin = choice<PixelOrigin>("--pixel-origin", pixel_origin_names(), arguments.origin);
  Camera camera = read_calibration(arguments.calib);
  const double shift_px = origin == PixelOrigin::kCorner ? 0.5 : 0;
  camera.cx -= shift_px;
  camera.cy -= shift_px;
  return camera;
}

double side_of(const MarkersDetectArguments& arguments, const MarkerLayout& layout, int id) {
  for (const PlacedMarker& marker : layout.markers)
    if (marker.id == id) return marker.side_m;
  if (const auto unplaced = layout.unplaced_sides_m.find(id);
      unplaced != layout.unplaced_sides_m.end())
    return unplaced->second;
  return arguments.side_m;
}

ordered_json marker_json(const DetectedMarker& marker, double shift_px) {
  ordered_json corners = ordered_json::array(), sigmas = ordered_json::array();
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector2d& px = marker.observation.corners_px[k];
    corners.push_back({px.x() + shift_px, px.y() + shift_px});
    const Eigen::Vector2d sigma = marker.observation.corner_covariance(k).diagonal().cwiseSqrt();
    sigmas.push_back({sigma.x(), sigma.y()});
  }
  ordered_json json = {{"id", marker.observation.id},
                       {"corners_px", corners},
                       {"corner_sigma_px", sigmas},
                       {"side_m", nullptr},
                       {"poses", ordered_json::array()}};
  if (marker.side_m > 0) json["side_m"] = marker.side_m;
  for (const MarkerPose& pose : marker.poses.poses)
    json["poses"].push_back({{"T_cam_marker", rows_json(pose.T_cam_marker.matrix())},
                             {"covariance", rows_json(pose.covariance)},
                             {"chi2", pose.chi2},
                             {"rms_px", pose.rms_px}});
  return json;
}

std::string marker_lines(const DetectedMarker& marker, double shift_px) {
  std::string text = fmt::format("  {:4d} ", marker.observation.id);
  for (const Eigen::Vector2d& px : marker.observation.corners_px)
    text += fmt::format(" ({:.2f}, {:.2f})", px.x() + shift_px, px.y() + shift_px);
  text += " px\n";
  for (const MarkerPose& pose : marker.poses.poses) {
    const Eigen::Vector3d& t = pose.T_cam_marker.translation();
    const Eigen::Vector3d w = pose.T_cam_marker.rotation().log() * (180 / std::numbers::pi);
    text += fmt::format(
        "        at {:.4f} {:.4f} {:.4f} m, turned by {:.2f} {:.2f} {:.2f} deg, chi2 {:.1f}\n",
        t.x(), t.y(), t.z(), w.x(), w.y(), w.z(), pose.chi2);
  }
  return text;
}

void write_drawing(const std::string& path, const Image& grey,
                   const std::vector<DetectedMarker>& markers, const Camera& camera) {
  std::vector<DrawnMarker> drawn;
  for (const DetectedMarker& marker : markers) {
    drawn.push_back({marker.observation, std::nullopt, marker.side_m});
    if (marker.poses.outcome) drawn.back().T_cam_marker = marker.poses.poses[0].T_cam_marker;
  }
  write_png(path, draw_markers(grey, drawn, camera));
}

}  // namespace

const std::vector<std::string>& pixel_origin_names() {
  static const std::vector<std::string> names = {"centre", "corner"};
  return names;
}

MarkersDetectResult markers_detect(const MarkersDetectArguments& arguments) {
  require(std::isfinite(arguments.side_m), "--side: must be a finite number");
  for (const std::string& file : {arguments.out, arguments.drawing})
    if (!file.empty()) require_free(file, arguments.force);
  MarkerLayout layout;
  layout.dictionary = arguments.dictionary;
  if (!arguments.layout.empty()) layout = read_marker_layout(arguments.layout);
  const MarkerDetector detector(arguments.options, layout.dictionary);
  const Camera camera = camera_of(arguments);
  const Image grey = read_image(arguments.image).grey;
  require_size(arguments.image, grey, camera.width, camera.height);

  MarkersDetectResult result{.image = arguments.image,
                             .dictionary = layout.dictionary,
                             .origin = arguments.origin,
                             .markers = {},
                             .camera = {}};
  const Stopwatch watch;
  const std::vector<MarkerObservation> markers = detector.detect(grey, &camera);
  for (const MarkerObservation& observation : markers) {
    DetectedMarker found{observation, side_of(arguments, layout, observation.id), {}};
    if (found.side_m > 0) found.poses = estimate_marker_poses(observation, found.side_m, camera);
    result.markers.push_back(std::move(found));
  }
  if (!arguments.layout.empty())
    result.camera = estimate_layout_pose(grey, markers, layout, camera);
  result.cpu_ms = watch.cpu_ms();
  if (result.markers.empty() && !(result.camera && result.camera->outcome))
    throw NoResult(arguments.image + ": no marker of " + layout.dictionary);
  if (!arguments.out.empty()) write_file(arguments.out, to_json(result));
  if (!arguments.drawing.empty()) write_drawing(arguments.drawing, grey, result.markers, camera);
  return result;
}

std::string to_text(const MarkersDetectResult& result) {
  std::string text =
      fmt::format("{}: {} markers of {}\n", result.image, result.markers.size(), result.dictionary);
  for (const DetectedMarker& marker : result.markers)
    text += marker_lines(marker, result.shift_px());
  if (result.camera && result.camera->outcome) {
    const Eigen::Vector3d& t = result.camera->T_world_cam.translation();
    text += fmt::format("  camera at {:.4f} {:.4f} {:.4f} m in the layout's world\n", t.x(), t.y(),
                        t.z());
  } else if (result.camera) {
    text += fmt::format("  no pose of the camera: {}\n", result.camera->outcome.reason);
  }
  return text + fmt::format("  {:.1f} ms CPU\n", result.cpu_ms);
}

std::string to_json(const MarkersDetectResult& result) {
  ordered_json json = {{"in", result.image},
                       {"dictionary", result.dictionary},
                       {"pixel_origin", result.origin},
                       {"markers", ordered_json::array()}};
  for (const DetectedMarker& marker : result.markers)
    json["markers"].push_back(marker_json(marker, result.shift_px()));
  if (result.camera) {
    json["T_world_cam"] = nullptr;
    json["outcome"] = to_string(result.camera->outcome.code);
    if (result.camera->outcome) {
      json["T_world_cam"] = rows_json(result.camera->T_world_cam.matrix());
      json["covariance"] = rows_json(result.camera->covariance);
    }
  }
  json["cpu_ms"] = result.cpu_ms;
  return json_text(json, 2);
}

}  // namespace placegraph::apps
