#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/flight/flight_estimator.h>
#include <placegraph/pipeline/flight/start_state.h>

#include <utility>

namespace placegraph {
namespace {

using Code = Outcome::Code;

const FlightOptions& checked(const FlightOptions& options) {
  options.check();
  return options;
}

}  // namespace

FlightEstimator::FlightEstimator(const FlightOptions& options, const Camera& camera,
                                 const SE3& T_body_cam, const MarkerLayout& layout)
    : options_(checked(options)),
      R_body_cam_(T_body_cam.rotation()),
      flow_(options.flow, camera, T_body_cam, options.floor_z_m),
      imu_(T_body_cam.rotation(), options.filter.gyro_noise),
      delayed_poses_(options.marker_delay_s),
      filter_(options.filter, T_body_cam, options.floor_z_m) {
  if (!layout.markers.empty() || !layout.beacons_world.empty())
    markers_.emplace(options.marker_sensor, camera, T_body_cam, layout);
}

void FlightEstimator::start(const BodyState& state) {
  filter_.start(state);
  delayed_poses_.clear();
  if (last_) last_->state.reset();
  for (const ImuSample& sample : imu_.samples())
    if (sample.stamp_ns > state.stamp_ns) (void)filter_.add(sample);
}

Outcome FlightEstimator::add(const ImuSample& sample) {
  const Outcome kept = imu_.add(sample);
  if (!kept) return kept;
  return filter_.started() ? filter_.add(sample)
                           : Outcome::failure(Code::kNotAttempted, "no marker was seen yet");
}

FlightFrame FlightEstimator::add(const Frame& frame, bool markers_visible) {
  const std::optional<BodyState> expected = filter_.expectation(frame.stamp_ns).state;
  FlightMeasurements observations;
  observations.stamp_ns = frame.stamp_ns;
  observations.flow =
      flow_.track(frame.image, last_ ? last_->state : std::nullopt, expected, times_);
  if (markers_ && markers_visible) {
    MarkerDetections found = markers_->detect(frame.image, expected, times_);
    observations.markers = std::move(found.markers);
    observations.beacons = std::move(found.beacons);
  }
  return add(observations);
}

FlightFrame FlightEstimator::add(const FlightMeasurements& observations) {
  const std::int64_t now_ns = observations.stamp_ns;
  require(!last_ || now_ns > last_->stamp_ns,
          "FlightEstimator: the image is not after the last one");
  FlightFrame result;
  result.stamp_ns = now_ns;

  // 1. Flow since the last image, without the camera's rotation, corrects velocity and height.
  const KnownRotation rotation =
      last_ ? imu_.camera_rotation(last_->stamp_ns, now_ns, last_->state) : KnownRotation{};
  use_flow(observations, rotation, result);

  // 2. Markers become a pose. It starts the filter, or corrects it once its delay has passed.
  use_markers(observations, rotation, result);
  const Outcome delivered = deliver_poses(now_ns);
  if (result.markers && !delivered) result.markers = delivered;
  if (markers_) markers_->report(result.markers, !observations.markers.empty());

  // 3. The state with all measurements available until now.
  const ErrorStateFilter::StateEstimate estimate = filter_.at(now_ns);
  result.outcome = estimate.outcome;
  result.state = estimate.state;
  last_ = LastImage{now_ns, estimate.outcome ? std::optional(estimate.state) : std::nullopt};
  imu_.forget_before(now_ns);
  return result;
}

void FlightEstimator::use_flow(const FlightMeasurements& observations,
                               const KnownRotation& rotation, FlightFrame& result) {
  const auto span = times_.measure("flow");
  const FloorFlowMeasurement measured = flow_.measure(
      observations.flow, last_ ? last_->state : std::nullopt, observations.stamp_ns, rotation);
  result.flow = measured.outcome;
  result.flow_points = measured.inliers;
  result.flow_chi2 = measured.chi2_per_dof;
  result.flow_measurement = measured.observation;
  if (measured.observation) result.flow = filter_.add(*measured.observation);
}

void FlightEstimator::use_markers(const FlightMeasurements& observations,
                                  const KnownRotation& rotation, FlightFrame& result) {
  if (!markers_) {
    result.markers = Outcome::failure(Code::kNotAttempted, "there are no markers");
    return;
  }
  const auto span = times_.measure("markers");
  MarkerView view{observations.stamp_ns, observations.markers, observations.beacons,
                  imu_.mean_force_body(), std::nullopt};
  if (last_ && imu_.samples().size() > 1)
    view.rotation_body = R_body_cam_ * rotation.R_1_2 * R_body_cam_.inverse();
  const BodyExpectation expectation = filter_.expectation(observations.stamp_ns);
  const bool restarts = !markers_->relies_on(expectation);
  const MarkerPoseEstimate estimate = markers_->estimate(view, expectation);
  result.markers = estimate.outcome;
  if (!estimate.outcome) return;
  result.markers_seen = estimate.markers;
  result.beacons_seen = estimate.beacons;
  result.pose_measurement = estimate.observation;
  if (restarts)
    result.markers = start_by(estimate.observation);
  else
    delayed_poses_.push(estimate.observation);
}

/// Starts, or restarts, at the pose from markers; the biases that the filter knows are kept.
Outcome FlightEstimator::start_by(const PoseMeasurement& pose) {
  if (!imu_.reaches(pose.stamp_ns, options_.filter.max_prediction_s))
    return Outcome::failure(Code::kTooFewData, "no inertial samples to begin with");
  start(start_state(pose, options_.initialization, filter_.expectation(pose.stamp_ns).state));
  return Outcome::ok();
}

/// Passes the poses whose delay has passed to the filter, which rejects those older than its
/// history.
Outcome FlightEstimator::deliver_poses(std::int64_t now_ns) {
  Outcome last = Outcome::ok();
  for (const PoseMeasurement& pose : delayed_poses_.take(now_ns)) last = filter_.add(pose);
  return last;
}

}  // namespace placegraph
