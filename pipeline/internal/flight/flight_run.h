#pragma once
#include <placegraph/io/datasets/dataset.h>
#include <placegraph/io/sensors/imu_file.h>
#include <placegraph/pipeline/internal/flight/flight_estimator.h>

#include <functional>
#include <limits>
#include <vector>

namespace placegraph {

/// A stretch of time from the first image on.
struct TimeSpan {
  double from_s = 0, to_s = 0;
};

/// A flight over a recorded sequence: what `placegraph hover` sets.
struct FlightRunOptions {
  FlightOptions hover;
  std::vector<TimeSpan> blind;  ///< images in these are not looked at for markers
  double predict_ahead_s = 0;  ///< states are told so long after their image, from what came before
  std::optional<BodyState> start;  ///< begins with this state, from the first image after it on
};

struct FlightRun {
  std::vector<FlightFrame>
      frames;  ///< one an image; the stamps of states are `predict_ahead_s` later
  std::vector<StageTimes::Stage> stages;  ///< reading first
};

/// Hands the images of one camera and the inertial samples to a FlightEstimator in the order of
/// their stamps. Throws as FlightEstimator and the data set do.
FlightRun run_flight(const Dataset& images, const ImuRecording& imu, const SE3& T_body_cam,
                     const MarkerLayout& layout, const FlightRunOptions& options,
                     const std::function<void(std::size_t done)>& progress = {});

/// The same measurements in a sliding window of `states` images: what is known of each image when
/// it leaves the window, that much later (the last ones at the end). Begins with the first
/// state of the filter; nothing of images before that.
std::vector<BodyState> smooth_flight(const FlightRun& run, const ImuRecording& imu,
                                     const SE3& T_body_cam, const FlightOptions& options,
                                     int states = 20);

}  // namespace placegraph
