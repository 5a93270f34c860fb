#pragma once
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/graph/measurements/marker_layout.h>
#include <placegraph/io/datasets/dataset.h>
#include <placegraph/io/sensors/imu_file.h>
#include <placegraph/pipeline/flight/flight_frame.h>
#include <placegraph/pipeline/flight/flight_options.h>

#include <functional>
#include <limits>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A time interval relative to the first image.
struct TimeSpan {
  double from_s = 0, to_s = 0;
};

/// A flight over a recorded sequence: the options of `placegraph flight run`.
struct FlightRunOptions {
  FlightOptions flight;
  std::vector<TimeSpan> blind;  ///< intervals whose images are not searched for markers
  /// Time by which states are predicted beyond their image, from data up to the image [s].
  double predict_ahead_s = 0;
  std::optional<BodyState>
      initial_state;  ///< initial state; the run starts at the first image after it
};

struct FlightRun {
  std::vector<FlightFrame>
      /// One per image; the stamps of states are `predict_ahead_s` later.
      frames;
  std::vector<StageTime> stages;  ///< CPU time of the stages; reading comes first
};

/// Passes the images of one camera and the inertial samples to a FlightEstimator in the order of
/// their stamps. Throws as FlightEstimator and the data set do.
FlightRun run_flight(const Dataset& images, const ImuRecording& imu, const SE3& T_body_cam,
                     const MarkerLayout& layout, const FlightRunOptions& options,
                     const std::function<void(std::size_t done)>& progress = {});

/// Smooths the same measurements in a sliding window of `states` images: returns the state of each
/// image when it leaves the window (those of the last images at the end). Begins with the first
/// state of the filter; earlier images have no result.
std::vector<BodyState> smooth_flight(const FlightRun& run, const ImuRecording& imu,
                                     const SE3& T_body_cam, const FlightOptions& options,
                                     int states = 20);

}  // namespace placegraph
