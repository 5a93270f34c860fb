#include <placegraph/io/calibration/calibration_plausibility.h>
#include <placegraph/pipeline/health/motion_check.h>
#include <placegraph/pipeline/health/stereo_check.h>
#include <placegraph/pipeline/run_notes.h>

namespace placegraph {

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

}  // namespace placegraph
