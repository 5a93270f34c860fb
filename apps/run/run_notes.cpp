#include "apps/run/run_notes.h"

#include <placegraph/io/internal/calibration/calibration_plausibility.h>
#include <placegraph/pipeline/internal/motion_check.h>
#include <placegraph/pipeline/internal/stereo_check.h>

#include <filesystem>
#include <nlohmann/json.hpp>

namespace placegraph::apps {

using nlohmann::json;

std::vector<DataNote> notes_of(const Dataset& dataset, const RunOptions& options) {
  std::vector<DataNote> notes = dataset.notes();
  const Sensor sensor = choose_sensor(dataset, options.sensor);
  if (sensor == Sensor::kStereo)
    if (const auto note =
            odd_rows(check_rows(dataset), dataset.calibration(Sensor::kStereo).camera))
      notes.push_back(*note);
  if (options.camera_height_m > 0 && sensor != Sensor::kMono)
    notes.push_back({"the camera height does not set the scale: the " +
                     std::string(sensor == Sensor::kStereo ? "stereo pair" : "depth") + " does"});
  if (options.camera_height_m > 0)
    if (const auto note = odd_camera_height(options.camera_height_m)) notes.push_back(*note);
  return notes;
}

std::optional<DataNote> note_of_unused_imu(const std::string& sequence) {
  for (const char* file : {"mav0/imu0/data.csv", "imu0/data.csv"})
    if (std::filesystem::exists(std::filesystem::path(sequence) / file))
      return DataNote{"the inertial measurements of imu0 are not used (`flight run` uses them)"};
  return std::nullopt;
}

std::vector<DataNote> notes_of_motion(const RunResult& run, const Trajectory& optimized) {
  std::vector<DataNote> notes;
  if (!run.map.metric) return notes;
  if (const auto note = odd_speed(optimized)) notes.push_back(*note);
  if (run.sensor == Sensor::kMono && run.calibration.camera_height_m) {
    const NearestSides sides = nearest_sides(run.map, *run.calibration.camera_height_m);
    auto note = odd_sides(sides);
    if (!note && !sides.are_upright())
      note = odd_posture(run.calibration.camera, rotations_of(optimized));
    if (note) notes.push_back(*note);
  }
  return notes;
}

void add_notes(const std::vector<DataNote>& notes, json& summary) {
  summary["notes"] = json::array();
  for (const DataNote& note : notes) {
    summary["notes"].push_back(note.text);
    if (note.doubts_scale) summary["metric"] = false, summary["scale_doubted"] = true;
  }
}

json describe_unposed(const RunResult& run) {
  json unposed = json::array();
  for (const UnposedFrames& frames : run.unposed)
    unposed.push_back({{"reason", frames.reason}, {"frames", frames.count}});
  return unposed;
}

std::string why_unposed(const RunResult& run) {
  if (run.unposed.empty()) return "";
  return ": " + run.unposed.front().reason + " (" + std::to_string(run.unposed.front().count) +
         " of " + std::to_string(run.map.frames.size()) +
         (run.map.frames.size() == 1 ? " frame)" : " frames)");
}

}  // namespace placegraph::apps
