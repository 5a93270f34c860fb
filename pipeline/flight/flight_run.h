#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/graph/measurements/body_state.h>
#include <placegraph/graph/measurements/marker_layout.h>
#include <placegraph/io/datasets/dataset.h>
#include <placegraph/io/sensors/imu_file.h>
#include <placegraph/pipeline/flight/flight_options.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A time interval relative to the first image.
struct TimeSpan {
  double from_s = 0;  ///< begin [s]
  double to_s = 0;    ///< end [s]
};

/// A flight over a recorded sequence: the options of `placegraph flight run`.
struct FlightRunOptions {
  FlightOptions flight;         ///< options of the estimator
  std::vector<TimeSpan> blind;  ///< intervals whose images are not searched for markers
  /// Time by which states are predicted beyond their image, from data up to the image [s].
  double predict_ahead_s = 0;
  std::optional<BodyState>
      initial_state;  ///< initial state; the run starts at the first image after it
};

/// Result of one image.
struct FlightFrame {
  std::int64_t stamp_ns = 0;
  Outcome outcome;  ///< outcome of `state`: see ErrorStateFilter::at
  BodyState state;
  Outcome flow;          ///< whether flow over the floor was measured and accepted
  int flow_points = 0;   ///< inliers of the flow
  double flow_chi2 = 0;  ///< chi2 of the inliers, per degree of freedom
  Outcome markers;       ///< whether a pose by markers was measured and accepted
  /// The measurements, accepted or not, for a smoother that runs in addition to the filter.
  std::optional<FlowMeasurement> flow_measurement;
  std::optional<PoseMeasurement> pose_measurement;
  int markers_seen = 0, beacons_seen = 0;  ///< number used to compute the pose
};

/// Result of a flight.
struct FlightRun {
  /// One per image; the stamps of states are `predict_ahead_s` later.
  std::vector<FlightFrame> frames;
  std::vector<StageTime> stages;  ///< CPU time of the stages; reading comes first
};

/// Estimates a flight from the images of one camera and the inertial samples.
///
/// A FlightEstimator receives both in the order of their stamps. `progress` receives the number of
/// images done. Throws as FlightEstimator and the data set do.
FlightRun run_flight(const Dataset& images, const ImuRecording& imu, const SE3& T_body_cam,
                     const MarkerLayout& layout, const FlightRunOptions& options,
                     const std::function<void(std::size_t done)>& progress = {});

/// Smooths the same measurements in a sliding window of `states` images.
///
/// Returns the state of each image when it leaves the window (those of the last images at the end).
/// Begins with the first
/// state of the filter; earlier images have no result.
std::vector<BodyState> smooth_flight(const FlightRun& run, const ImuRecording& imu,
                                     const SE3& T_body_cam, const FlightOptions& options,
                                     int states = 20);

}  // namespace placegraph
