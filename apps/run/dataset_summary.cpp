#include "apps/run/dataset_summary.h"
#include <fmt/format.h>

namespace placegraph::apps {
namespace {

/// The calibration of a dataset for all its sensors together.
Calibration whole_calibration(const Dataset& dataset) {
  Calibration whole = dataset.calibration(Sensor::kMono);
  for (const Sensor sensor : dataset.sensors()) {
    const Calibration part = dataset.calibration(sensor);
    if (part.baseline_m > 0) whole.baseline_m = part.baseline_m;
    if (part.depth) whole.depth = part.depth;
  }
  return whole;
}

DatasetSummary::GroundTruth summarize_truth(const Trajectory& truth) {
  DatasetSummary::GroundTruth summary;
  const StampedPose* before = nullptr;
  for (const StampedPose& pose : truth.poses) {
    if (!pose.T_world_body) continue;
    ++summary.posed;
    if (before)
      summary.path_m +=
          (pose.T_world_body->translation() - before->T_world_body->translation()).norm();
    before = &pose;
  }
  return summary;
}

}  // namespace

DatasetSummary summarize(const Dataset& dataset) {
  DatasetSummary summary;
  summary.name = dataset.name();
  summary.format = dataset.format();
  summary.frames = dataset.size();
  std::vector<std::int64_t> stamps_ns;
  for (std::size_t i = 0; i < dataset.size(); ++i) stamps_ns.push_back(dataset.stamp_ns(i));
  if (!stamps_ns.empty()) {
    summary.first_ns = stamps_ns.front();
    summary.last_ns = stamps_ns.back();
  }
  summary.spacing = stamp_spacing(stamps_ns);
  summary.sensors = dataset.sensors();
  summary.calibration = whole_calibration(dataset);
  if (dataset.ground_truth()) summary.truth = summarize_truth(*dataset.ground_truth());
  summary.notes = dataset.notes();
  return summary;
}

std::string metric_by(Sensor sensor, const Calibration& calibration) {
  if (sensor == Sensor::kStereo)
    return fmt::format("the baseline of {:.4g} m", calibration.baseline_m);
  if (sensor == Sensor::kRgbd) return "the depth images";
  if (calibration.camera_height_m)
    return fmt::format("the camera's height of {:.4g} m", *calibration.camera_height_m);
  return {};
}

}  // namespace placegraph::apps
