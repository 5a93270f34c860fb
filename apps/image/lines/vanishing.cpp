#include "apps/image/lines/vanishing.h"

#include <fmt/format.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/measurements/segment_file.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/support/numbers_json.h"
#include "apps/support/output.h"
#include "apps/support/read_calib.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

using nlohmann::ordered_json;

ordered_json vector_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

ordered_json frame_json(const ManhattanFrame& frame) {
  return {{"R_cam_manhattan", rows_json(frame.R_cam_manhattan.matrix())},
          {"covariance", rows_json(frame.covariance)},
          {"segments", frame.segments},
          {"evidence_nats", frame.evidence},
          {"orthogonality_deg", frame.orthogonality_deg},
          {"log_odds", frame.log_odds},
          {"axis_of_segment", frame.axis}};
}

/// A vanishing point and its relation to the Manhattan frames.
ordered_json point_json(const VanishingPoint& point, const PointRole& role) {
  ordered_json json = {{"covariance", rows_json(point.covariance)},
                       {"segments", point.segments},
                       {"evidence_nats", point.evidence},
                       {"world", nullptr},
                       {"axis", nullptr},
                       {"across", nullptr}};
  if (role.axis >= 0) {
    json["world"] = role.frame;
    json["axis"] = role.axis;
  } else if (role.across_axis >= 0) {
    json["across"] = {{"world", role.across_frame}, {"axis", role.across_axis}};
  }
  return json;
}

std::string role_text(const PointRole& role) {
  if (role.axis >= 0) return fmt::format(", axis {} of frame {}", role.axis, role.frame);
  if (role.across_axis < 0) return "";
  return fmt::format(", orthogonal to axis {} of frame {}", role.across_axis, role.across_frame);
}

}  // namespace

VanishingResult vanishing(const VanishingArguments& arguments) {
  arguments.options.check();
  const std::vector<LineSegment> segments = read_segment_columns(arguments.in);
  const Camera camera = read_calib_without_distortion(arguments.calib, "segments need");
  VanishingResult result{arguments.in, segments.size(), {}, 0};
  const Stopwatch watch;
  Random random(arguments.seed);
  result.scene = find_scene_directions(segments, camera, arguments.options, random);
  result.cpu_ms = watch.cpu_ms();
  // Segments without a common direction are a valid result.
  if (result.scene.vanishing.outcome.code == Outcome::Code::kTooFewData)
    throw NoResult(arguments.in + ": " + result.scene.vanishing.outcome.reason);
  return result;
}

std::string to_text(const VanishingResult& result) {
  const SceneDirections& scene = result.scene;
  const VanishingPoints& vanishing = scene.vanishing;
  std::string text =
      fmt::format("{}: {} segments, {} vanishing points, {} Manhattan frames\n", result.in,
                  result.segments, vanishing.points.size(), scene.frames.size());
  for (std::size_t i = 0; i < vanishing.points.size(); ++i) {
    const Eigen::Vector3d& v = vanishing.points[i].direction;
    const PointRole role = scene.roles[i];
    text += fmt::format("  {:8.5f} {:8.5f} {:8.5f}  {} segments{}\n", v.x(), v.y(), v.z(),
                        vanishing.points[i].segments, role_text(role));
  }
  for (std::size_t f = 0; f < scene.frames.size(); ++f) {
    const ManhattanFrame& frame = scene.frames[f];
    const Eigen::Vector3d w = frame.R_cam_manhattan.log() * (180 / std::numbers::pi);
    const Eigen::Vector3d s = frame.covariance.diagonal().cwiseSqrt() * (180 / std::numbers::pi);
    text += fmt::format(
        "  frame {}: rotation vector {:.3f} {:.3f} {:.3f} deg, sigma {:.3f} {:.3f} {:.3f} deg\n", f,
        w.x(), w.y(), w.z(), s.x(), s.y(), s.z());
  }
  if (scene.frames.empty()) text += "  no Manhattan frame: too little evidence\n";
  return text + fmt::format("  {:.1f} ms CPU\n", result.cpu_ms);
}

std::string to_json(const VanishingResult& result) {
  const SceneDirections& scene = result.scene;
  const VanishingPoints& vanishing = scene.vanishing;
  ordered_json json;
  json["in"] = result.in;
  json["segments"] = result.segments;
  json["manhattan_supported"] = !scene.frames.empty();
  json["R_cam_manhattan"] = nullptr;
  json["covariance"] = nullptr;
  if (!scene.frames.empty()) {
    json["R_cam_manhattan"] = rows_json(scene.frames[0].R_cam_manhattan.matrix());
    json["covariance"] = rows_json(scene.frames[0].covariance);
  }
  json["vanishing_points"] = ordered_json::array();
  json["points"] = ordered_json::array();
  for (std::size_t i = 0; i < vanishing.points.size(); ++i) {
    json["vanishing_points"].push_back(vector_json(vanishing.points[i].direction));
    json["points"].push_back(point_json(vanishing.points[i], scene.roles[i]));
  }
  json["labels"] = vanishing.labels;
  json["worlds"] = ordered_json::array();
  for (const ManhattanFrame& frame : scene.frames) json["worlds"].push_back(frame_json(frame));
  json["noise"] = {{"end_px", vanishing.noise.end_px},
                   {"parallel_deg", vanishing.noise.parallel_deg}};
  json["cpu_ms"] = result.cpu_ms;
  return json_text(json, 2);
}

}  // namespace placegraph::apps
