#pragma once
#include <placegraph/graph/internal/measurements/stamp_spacing.h>
#include <placegraph/io/datasets/dataset.h>

namespace placegraph {

/// What a recorded sequence holds, in figures; nothing of its images is read for it.
struct DatasetSummary {
  std::string name, format;
  std::size_t frames = 0;
  std::int64_t first_ns = 0, last_ns = 0;
  StampSpacing spacing;
  std::vector<Sensor> sensors;  ///< what it can be run as, best first
  Calibration calibration;      ///< of everything it hands out for any sensor
  struct GroundTruth {
    std::size_t posed = 0;  ///< frames that have a pose
    double path_m = 0;      ///< length of the way through the poses
  };
  std::optional<GroundTruth> truth;
  std::vector<DataNote> notes;  ///< what was left out in reading, and what is odd
};

DatasetSummary summarize(const Dataset& dataset);

/// Where lengths in metres come from when `sensor` runs with `calibration`: "the baseline of 0.537
/// m", "the depth images", "the camera's height of 1.65 m"; empty where nothing tells them.
std::string metric_by(Sensor sensor, const Calibration& calibration);

}  // namespace placegraph
