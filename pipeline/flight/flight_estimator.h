#pragma once
#include <placegraph/backend/inertial/error_state_filter.h>
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/measurements/marker_layout.h>
#include <placegraph/pipeline/flight/delay_line.h>
#include <placegraph/pipeline/flight/flight_options.h>
#include <placegraph/pipeline/flight/flight_run.h>
#include <placegraph/pipeline/flight/floor_flow.h>
#include <placegraph/pipeline/flight/imu_buffer.h>
#include <placegraph/pipeline/flight/marker_sensor.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace placegraph {

/// Measurements in one image.
struct FlightMeasurements {
  std::int64_t stamp_ns = 0;
  std::vector<FlowVector> flow = {};  ///< flow from the previous image to this one
  std::vector<MarkerObservation> markers = {};
  std::vector<BeaconObservation> beacons = {};
};

/// Estimates the pose of a small flying robot image by image: flow over the floor without the
/// rotation measured by the gyro is velocity over height (FloorFlow), markers provide poses
/// (MarkerSensor), and an error-state filter fuses both with the inertial sensor. It starts with
/// the first markers that determine a unique pose, and restarts if markers contradict it
/// persistently; before the start, and whenever its inputs stop, it has no state.
class FlightEstimator {
 public:
  /// `camera` has no distortion. World: z up. Throws ArgumentError if an option is out of range.
  FlightEstimator(const FlightOptions& options, const Camera& camera, const SE3& T_body_cam,
                  const MarkerLayout& layout);

  /// Adds inertial samples in the order of their stamps, before the images at or after them.
  /// Outcomes as ErrorStateFilter's; samples before the start are kept.
  Outcome add(const ImuSample& sample);
  /// Processes the next image; with `markers_visible` false it is not searched for markers.
  FlightFrame add(const Frame& frame, bool markers_visible = true);
  /// Processes measurements of an image that were made elsewhere. Throws ArgumentError if its stamp
  /// is not after that of the previous image.
  FlightFrame add(const FlightMeasurements& observations);
  /// Starts with an externally given state instead of with markers.
  void start(const BodyState& state);

  /// State at a time from the last image on, predicted to the last inertial sample.
  ErrorStateFilter::StateEstimate at(std::int64_t stamp_ns) const { return filter_.at(stamp_ns); }
  const StageTimes& times() const { return times_; }

 private:
  struct LastImage {
    std::int64_t stamp_ns = 0;
    std::optional<BodyState> state;  // state at the image, if it was known
  };

  void use_flow(const FlightMeasurements& observations, const KnownRotation& rotation,
                FlightFrame& result);
  void use_markers(const FlightMeasurements& observations, const KnownRotation& rotation,
                   FlightFrame& result);
  Outcome start_by(const PoseMeasurement& pose);
  Outcome deliver_poses(std::int64_t now_ns);

  FlightOptions options_;
  SO3 R_body_cam_;
  FloorFlow flow_;
  std::optional<MarkerSensor> markers_;  // nothing: the layout has neither markers nor beacons
  ImuBuffer imu_;
  DelayLine<PoseMeasurement> delayed_poses_;
  ErrorStateFilter filter_;
  std::optional<LastImage> last_;
  StageTimes times_;
};

}  // namespace placegraph
