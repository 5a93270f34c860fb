#include "apps/run/inspect.h"

#include <fmt/format.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/time.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/pipeline/run.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/run/run_notes.h"
#include "apps/support/image_range.h"
#include "apps/support/progress.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

UnreadableFrames read_all(const Dataset& dataset, Sensor sensor) {
  UnreadableFrames unreadable;
  Progress progress("reading " + dataset.name(), static_cast<std::int64_t>(dataset.size()));
  for (std::size_t i = 0; i < dataset.size(); ++i) {
    try {
      dataset.frame(i, sensor);
    } catch (const Error& error) {
      if (unreadable.count++ == 0) unreadable.first = error.what();
    }
    progress.update(static_cast<std::int64_t>(i + 1));
  }
  return unreadable;
}

/// Horizontal and vertical field of view of an undistorted image.
Eigen::Vector2d field_of_view_deg(const Camera& camera) {
  const auto angle_deg = [](double size, double centre, double focal) {
    return rad_to_deg(std::atan((centre + 0.5) / focal) + std::atan((size - 0.5 - centre) / focal));
  };
  return {angle_deg(camera.width, camera.cx, camera.fx),
          angle_deg(camera.height, camera.cy, camera.fy)};
}

json describe_camera(const Camera& camera) {
  return {{"width", camera.width}, {"height", camera.height}, {"fx", camera.fx},
          {"fy", camera.fy},       {"cx", camera.cx},         {"cy", camera.cy}};
}

json describe_calibration(const Calibration& calibration) {
  json text = describe_camera(calibration.camera);
  if (calibration.baseline_m > 0) text["baseline_m"] = calibration.baseline_m;
  if (calibration.camera_height_m) text["camera_height_m"] = *calibration.camera_height_m;
  if (calibration.depth) text["depth"] = describe_camera(calibration.depth->camera);
  return text;
}

json describe_times(const DatasetSummary& summary) {
  json gaps = json::array();
  for (const StampGap& gap : summary.spacing.gaps)
    gaps.push_back({{"after_frame", gap.after}, {"seconds", gap.seconds}});
  const StampSpacing& spacing = summary.spacing;
  return {{"first_s", seconds(0, summary.first_ns)},
          {"last_s", seconds(0, summary.last_ns)},
          {"rate_hz", spacing.median_s > 0 ? json(1 / spacing.median_s) : json(nullptr)},
          {"spacing_s",
           {{"median", spacing.median_s},
            {"least", spacing.least_s},
            {"greatest", spacing.greatest_s}}},
          {"gaps", gaps},
          {"missing", spacing.missing}};
}

/// Sensor and cues of `placegraph run` without options.
json describe_use(const DatasetSummary& summary) {
  const Sensor sensor = summary.sensors.front();
  const std::string metric = metric_by(sensor, summary.calibration);
  const bool doubted =
      std::ranges::any_of(summary.notes, [](const DataNote& note) { return note.doubts_scale; });
  return {{"sensor", to_string(sensor)},
          {"cues", RunOptions().slam.odometry.cues},
          {"metric", !metric.empty() && !doubted},
          {"metric_by", metric.empty() ? json(nullptr) : json(metric)}};
}

json describe(const DatasetSummary& summary) {
  json sensors = json::array(), notes = json::array();
  for (const Sensor sensor : summary.sensors) sensors.push_back(to_string(sensor));
  for (const DataNote& note : summary.notes)
    notes.push_back({{"text", note.text}, {"doubts_scale", note.doubts_scale}});
  json truth;
  if (summary.truth) truth = {{"posed", summary.truth->posed}, {"path_m", summary.truth->path_m}};
  return {{"sequence", summary.name},    {"format", summary.format},
          {"frames", summary.frames},    {"times", describe_times(summary)},
          {"sensors", sensors},          {"calibration", describe_calibration(summary.calibration)},
          {"ground_truth", truth},       {"notes", notes},
          {"run", describe_use(summary)}};
}

std::string line(const char* what, const std::string& text) {
  return fmt::format("{:<12} {}\n", what, text);
}

std::string times_text(const DatasetSummary& summary) {
  const StampSpacing& spacing = summary.spacing;
  if (summary.frames < 2) return line("frames", fmt::format("{}", summary.frames));
  const std::string frames =
      line("frames", fmt::format("{} in {:.2f} s, {:.4g} Hz ({:.3f} to {:.3f} s)", summary.frames,
                                 seconds(summary.first_ns, summary.last_ns), 1 / spacing.median_s,
                                 seconds(0, summary.first_ns), seconds(0, summary.last_ns)));
  if (spacing.gaps.empty()) return frames + line("gaps", "none");
  const auto longest = std::ranges::max_element(spacing.gaps, {}, &StampGap::seconds);
  return frames +
         line("gaps",
              fmt::format("{}, where about {} frames are missing; the longest is {:.3g} s "
                          "after frame {}",
                          spacing.gaps.size(), spacing.missing, longest->seconds, longest->after));
}

std::string camera_text(const Camera& camera) {
  const Eigen::Vector2d view = field_of_view_deg(camera);
  return fmt::format(
      "{} x {} px, fx {:.2f} fy {:.2f} cx {:.2f} cy {:.2f}, sees {:.0f} x {:.0f} "
      "degrees",
      camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy, view[0], view[1]);
}

/// Precondition: there is a depth camera.
std::string depth_text(const Calibration& calibration) {
  const Camera &camera = calibration.camera, &depth = calibration.depth->camera;
  const double apart_m = calibration.depth->T_cam_depth.translation().norm();
  const bool registered = apart_m == 0 && describe_camera(camera) == describe_camera(depth);
  return camera_text(depth) + (registered    ? ", registered to the camera"
                               : apart_m > 0 ? fmt::format(", {:.4g} m beside the camera", apart_m)
                                             : ", at the camera's place");
}

std::string calibration_text(const Calibration& calibration) {
  std::string text = line("camera", camera_text(calibration.camera) + " (undistorted)");
  if (calibration.baseline_m > 0)
    text += line("right camera", fmt::format("baseline {:.4g} m", calibration.baseline_m));
  if (calibration.depth) text += line("depth", depth_text(calibration));
  if (calibration.camera_height_m)
    text += line("height", fmt::format("{:.4g} m above the ground", *calibration.camera_height_m));
  return text;
}

std::string use_text(const DatasetSummary& summary) {
  const json use = describe_use(summary);
  std::string others;
  for (std::size_t i = 1; i < summary.sensors.size(); ++i)
    others += (i == 1 ? "" : ", ") + std::string(to_string(summary.sensors[i]));
  std::string text = "as " + use["sensor"].get<std::string>();
  if (!others.empty()) text += " (--sensor: also " + others + ")";
  text += ", cues " + use["cues"].get<std::string>();
  if (use["metric_by"].is_null())
    text += "; lengths without scale: --camera-height gives it to a camera above flat ground";
  else
    text += std::string(use["metric"] ? "; in metres by " : "; in doubtful metres by ") +
            use["metric_by"].get<std::string>();
  return line("run", text);
}

/// A folder of images that is no sequence, for the `reason` given; places can be recognized in it.
InspectResult inspect_images(const std::string& path, const std::string& reason) {
  InspectResult result;
  result.path = image_folder_of(path);
  result.images = list_images(result.path).size();
  result.no_sequence = reason;
  return result;
}

}  // namespace

InspectResult inspect(const InspectArguments& arguments) {
  std::unique_ptr<Dataset> dataset;
  try {
    dataset = open_dataset(arguments.path);
  } catch (const UnknownLayout& reason) {
    if (!holds_images(image_folder_of(arguments.path))) throw;
    return inspect_images(arguments.path, reason.what());
  }
  InspectResult result;
  result.path = arguments.path;
  result.summary = summarize(*dataset);
  result.summary.notes = notes_of(*dataset, RunOptions());
  if (arguments.read_all) result.unreadable = read_all(*dataset, result.summary.sensors.front());
  return result;
}

std::string to_json(const InspectResult& result) {
  if (result.no_sequence)
    return json_text(json({{"sequence", nullptr},
                           {"format", "images"},
                           {"frames", result.images},
                           {"run", nullptr},
                           {"reason", *result.no_sequence}}),
                     1);
  json text = describe(result.summary);
  if (result.unreadable) text["unreadable"] = result.unreadable->count;
  return json_text(text, 1);
}

std::string to_text(const InspectResult& result) {
  if (result.no_sequence)
    return line("images", fmt::format("{} in {}: usable by commands without calibration "
                                      "(places match, image lines, ...)",
                                      result.images, result.path)) +
           line("run", "not possible: " + *result.no_sequence);
  const DatasetSummary& summary = result.summary;
  std::string text = line(
      "sequence", fmt::format("{}, read as {} from {}", summary.name, summary.format, result.path));
  text += times_text(summary) + calibration_text(summary.calibration);
  text += line("truth", summary.truth
                            ? fmt::format("{} of {} frames, {:.1f} m long", summary.truth->posed,
                                          summary.frames, summary.truth->path_m)
                            : "none");
  for (const DataNote& note : summary.notes) text += line("note", note.text);
  text += use_text(summary);
  if (result.unreadable)
    text += line("images", fmt::format("{} of {} frames can be read",
                                       summary.frames - result.unreadable->count, summary.frames));
  return text;
}

}  // namespace placegraph::apps
