#pragma once
#include <placegraph/io/datasets/dataset.h>

#include "apps/run/stamp_spacing.h"

namespace placegraph::apps {

/// Statistics of a recorded sequence; no images are read for them.
struct DatasetSummary {
  std::string name, format;
  std::size_t frames = 0;
  std::int64_t first_ns = 0, last_ns = 0;
  StampSpacing spacing;
  std::vector<Sensor> sensors;  ///< supported sensors, best first
  Calibration calibration;      ///< calibration of all images for any sensor
  struct GroundTruth {
    std::size_t posed = 0;  ///< frames that have a pose
    double path_m = 0;      ///< path length through the poses
  };
  std::optional<GroundTruth> truth;
  std::vector<DataNote> notes;  ///< skipped data and implausible data
};

/// The statistics of a sequence.
DatasetSummary summarize(const Dataset& dataset);

/// The source of metric scale when `sensor` runs with `calibration`.
/// "The baseline of 0.537 m", "the depth images", "the camera's height of 1.65 m"; empty if the
/// scale is unknown.
std::string metric_by(Sensor sensor, const Calibration& calibration);

}  // namespace placegraph::apps
