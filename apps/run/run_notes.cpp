#include "apps/run/run_notes.h"

#include <placegraph/io/internal/calibration/calibration_plausibility.h>
#include <placegraph/pipeline/internal/motion_check.h>
#include <placegraph/pipeline/internal/stereo_check.h>

#include <nlohmann/json.hpp>

namespace placegraph::apps {

using nlohmann::json;

std::vector<DataNote> notes_of(const Dataset& dataset, const RunOptions& options) {
  std::vector<DataNote> notes = dataset.notes();
  if (choose_sensor(dataset, options.sensor) == Sensor::kStereo)
    if (const auto note =
            odd_rows(check_rows(dataset), dataset.calibration(Sensor::kStereo).camera))
      notes.push_back(*note);
  if (options.camera_height_m > 0)
    if (const auto note = odd_camera_height(options.camera_height_m)) notes.push_back(*note);
  return notes;
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
    if (note.doubts_scale) summary["metric"] = false;
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
