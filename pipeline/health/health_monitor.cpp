#include <placegraph/backend/window/window_state.h>
#include <placegraph/pipeline/health/health_monitor.h>
#include <placegraph/pipeline/odometry/odometry.h>
#include <placegraph/pipeline/tracking/frame_result.h>

namespace placegraph {

HealthMonitor::HealthMonitor(const Calibration& calibration)
    : right_(calibration), flow_(calibration), intrinsics_(calibration), residuals_(calibration) {}

void HealthMonitor::add(const Frame& frame, const FrameResult& result, const Odometry& odometry) {
  const ImageStatistics statistics = image_statistics(frame.image);
  images_.add(frame.id, statistics);
  if (statistics.range > 0) repeated_.add(frame);  // blank images are often equal
  if (!frame.right.empty()) right_images_.add(frame.id, image_statistics(frame.right));
  right_.add(frame, result.T_map_cam);
  range_.add(frame);
  flow_.add(frame, result.T_map_cam);
  if (!result.keyframe) return;
  examine(odometry.map().window());
  const std::optional<ScaleComparison>& compared = odometry.scale_compared();
  if (compared && compared->keyframe == odometry.map().newest())
    scale_.add(frame.id, compared->log_factor);
}

void HealthMonitor::examine(const SlidingWindow& window) {
  const std::vector<KeyframeId> keyframes = window.keyframes();
  if (static_cast<int>(keyframes.size()) < window.state().options.max_keyframes) return;
  if (keyframes.front() <= newest_) return;
  newest_ = keyframes.back();
  intrinsics_.add(window.state());
  residuals_.add(window_residuals(window.state()));
}

std::vector<DataNote> HealthMonitor::notes() const {
  std::vector<DataNote> notes;
  const auto collect = [&](const std::optional<DataNote>& note) {
    if (note) notes.push_back(*note);
  };
  collect(repeated_.note());
  collect(images_.note());
  collect(right_images_.note());
  collect(right_.note());
  collect(range_.note());
  collect(flow_.note());
  collect(scale_.note());
  for (const DataNote& note : intrinsics_.notes()) notes.push_back(note);
  for (const DataNote& note : residuals_.notes()) notes.push_back(note);
  return notes;
}

}  // namespace placegraph
