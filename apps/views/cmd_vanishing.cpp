#include "apps/views/cmd_vanishing.h"

#include <fmt/format.h>
#include <placegraph/frontend/vanishing/scene_directions.h>
#include <placegraph/io/measurements/segment_file.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/support/calib_option.h"
#include "apps/support/read_calib.h"
#include "apps/support/output.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

using nlohmann::ordered_json;

struct VanishingArguments {
  std::string in, camera;
  bool json = false;
  std::uint64_t seed = 1;
  SceneDirectionOptions options;
};

ordered_json vector_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Three rows of three.
ordered_json matrix_json(const Eigen::Matrix3d& M) {
  ordered_json rows = ordered_json::array();
  for (int i = 0; i < 3; ++i) rows.push_back(vector_json(M.row(i)));
  return rows;
}

ordered_json frame_json(const ManhattanFrame& frame) {
  return {{"R_cam_manhattan", matrix_json(frame.R_cam_manhattan.matrix())},
          {"covariance", matrix_json(frame.covariance)},
          {"segments", frame.segments},
          {"evidence_nats", frame.evidence},
          {"orthogonality_deg", frame.orthogonality_deg},
          {"log_odds", frame.log_odds},
          {"axis_of_segment", frame.axis}};
}

ordered_json scene_json(const VanishingArguments& arguments, std::size_t segments,
                        const SceneDirections& scene, double cpu_ms) {
  const VanishingPoints& vanishing = scene.vanishing;
  ordered_json json;
  json["in"] = arguments.in;
  json["segments"] = segments;
  json["manhattan_supported"] = !scene.frames.empty();
  json["R_cam_manhattan"] = nullptr;
  json["covariance"] = nullptr;
  if (!scene.frames.empty()) {
    json["R_cam_manhattan"] = matrix_json(scene.frames[0].R_cam_manhattan.matrix());
    json["covariance"] = matrix_json(scene.frames[0].covariance);
  }
  json["vanishing_points"] = ordered_json::array();
  json["points"] = ordered_json::array();
  for (std::size_t i = 0; i < vanishing.points.size(); ++i) {
    const VanishingPoint& point = vanishing.points[i];
    json["vanishing_points"].push_back(vector_json(point.direction));
    ordered_json one = {{"covariance", matrix_json(point.covariance)},
                        {"segments", point.segments},
                        {"evidence_nats", point.evidence},
                        {"world", nullptr},
                        {"axis", nullptr},
                        {"across", nullptr}};
    const PointRole role = scene.roles[i];
    if (role.axis >= 0) {
      one["world"] = role.frame;
      one["axis"] = role.axis;
    } else if (role.across_axis >= 0) {
      one["across"] = {{"world", role.across_frame}, {"axis", role.across_axis}};
    }
    json["points"].push_back(one);
  }
  json["labels"] = vanishing.labels;
  json["worlds"] = ordered_json::array();
  for (const ManhattanFrame& frame : scene.frames) json["worlds"].push_back(frame_json(frame));
  json["noise"] = {{"end_px", vanishing.noise.end_px},
                   {"parallel_deg", vanishing.noise.parallel_deg}};
  json["cpu_ms"] = cpu_ms;
  return json;
}

std::string role_text(const PointRole& role) {
  if (role.axis >= 0) return fmt::format(", axis {} of world {}", role.axis, role.frame);
  if (role.across_axis < 0) return "";
  return fmt::format(", at right angles to axis {} of world {}", role.across_axis,
                     role.across_frame);
}

void print(const VanishingArguments& arguments, std::size_t segments, const SceneDirections& scene,
           double cpu_ms) {
  const VanishingPoints& vanishing = scene.vanishing;
  fmt::print("{}: {} segments, {} vanishing points, {} rectangular worlds\n", arguments.in,
             segments, vanishing.points.size(), scene.frames.size());
  for (std::size_t i = 0; i < vanishing.points.size(); ++i) {
    const Eigen::Vector3d& v = vanishing.points[i].direction;
    const PointRole role = scene.roles[i];
    fmt::print("  {:8.5f} {:8.5f} {:8.5f}  {} segments{}\n", v.x(), v.y(), v.z(),
               vanishing.points[i].segments, role_text(role));
  }
  for (std::size_t f = 0; f < scene.frames.size(); ++f) {
    const ManhattanFrame& frame = scene.frames[f];
    const Eigen::Vector3d w = frame.R_cam_manhattan.log() * (180 / std::numbers::pi);
    const Eigen::Vector3d s = frame.covariance.diagonal().cwiseSqrt() * (180 / std::numbers::pi);
    fmt::print(
        "  world {}: turned by {:.3f} {:.3f} {:.3f} deg, known to {:.3f} {:.3f} {:.3f} deg\n", f,
        w.x(), w.y(), w.z(), s.x(), s.y(), s.z());
  }
  if (scene.frames.empty()) fmt::print("  no rectangular world: too little speaks for one\n");
  fmt::print("  {:.1f} ms CPU\n", cpu_ms);
}

void run(const VanishingArguments& arguments) {
  arguments.options.check();
  const std::vector<LineSegment> segments = read_segment_columns(arguments.in);
  const Camera camera = read_calib_without_distortion(arguments.camera, "segments need");
  const Stopwatch watch;
  Random random(arguments.seed);
  const SceneDirections scene = find_scene_directions(segments, camera, arguments.options, random);
  const double cpu_ms = watch.cpu_ms();
  // No common direction is an answer, too, where there were segments enough.
  if (scene.vanishing.outcome.code == Outcome::Code::kTooFewData)
    throw NoAnswer(arguments.in + ": " + scene.vanishing.outcome.reason);
  if (arguments.json)
    std::puts(scene_json(arguments, segments.size(), scene, cpu_ms).dump(2).c_str());
  else
    print(arguments, segments.size(), scene, cpu_ms);
}

}  // namespace

void add_vanishing_command(CLI::App& app) {
  auto arguments = std::make_shared<VanishingArguments>();
  VanishingArguments& a = *arguments;
  CLI::App* command = app.add_subcommand(
      "vanishing", "Find in which directions the straight edges of an image point");
  command->footer("placegraph vanishing segments.txt --calib K.txt --json");
  command->add_option("LINES", a.in, "lines of u1 v1 u2 v2 [px]; further columns are not read")
      ->required()
      ->check(CLI::ExistingFile);
  add_calib_option(*command, a.camera, kCalibFile)->required();
  command
      ->add_option("--noise", a.options.points.noise.end_px,
                   "of the ends of segments, about; it is estimated [px]")
      ->capture_default_str();
  command->add_option("--max-points", a.options.points.max_points, "vanishing points looked for")
      ->capture_default_str();
  command->add_option("--seed", a.seed, "of the random samples")->capture_default_str();
  command->add_flag("--json", a.json, "print JSON");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace placegraph::apps
