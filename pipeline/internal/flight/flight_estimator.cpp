#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/internal/flight/flight_estimator.h>
#include <placegraph/pipeline/internal/flight/start_state.h>

#include <utility>

namespace placegraph {
namespace {

using Code = Outcome::Code;

const HoverOptions& checked(const HoverOptions& options) {
  options.check();
  return options;
}

}  // namespace

FlightEstimator::FlightEstimator(const HoverOptions& options, const Camera& camera,
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

HoverFrame FlightEstimator::add(const Frame& frame, bool markers_visible) {
  const std::optional<BodyState> expected = filter_.expectation(frame.stamp_ns).state;
  HoverSights sights;
  sights.stamp_ns = frame.stamp_ns;
  sights.flow = flow_.track(frame.image, last_ ? last_->state : std::nullopt, expected, times_);
  if (markers_ && markers_visible) {
    MarkerDetections found = markers_->detect(frame.image, expected, times_);
    sights.markers = std::move(found.markers);
    sights.beacons = std::move(found.beacons);
  }
  return add(sights);
}

HoverFrame FlightEstimator::add(const HoverSights& sights) {
  const std::int64_t now_ns = sights.stamp_ns;
  require(!last_ || now_ns > last_->stamp_ns,
          "FlightEstimator: the image is not after the last one");
  HoverFrame result;
  result.stamp_ns = now_ns;

  // 1. Flow since the last image, without the camera's rotation, corrects velocity and height.
  const KnownRotation rotation =
      last_ ? imu_.camera_rotation(last_->stamp_ns, now_ns, last_->state) : KnownRotation{};
  use_flow(sights, rotation, result);

  // 2. Markers become a pose. It starts the filter, or corrects it once its delay has passed.
  use_markers(sights, rotation, result);
  const Outcome delivered = deliver_poses(now_ns);
  if (result.markers && !delivered) result.markers = delivered;
  if (markers_) markers_->report(result.markers, !sights.markers.empty());

  // 3. The state with all that has come until now.
  const PositionFilter::Answer answer = filter_.at(now_ns);
  result.outcome = answer.outcome;
  result.state = answer.state;
  last_ = LastImage{now_ns, answer.outcome ? std::optional(answer.state) : std::nullopt};
  imu_.forget_before(now_ns);
  return result;
}

void FlightEstimator::use_flow(const HoverSights& sights, const KnownRotation& rotation,
                               HoverFrame& result) {
  const auto span = times_.measure("flow");
  const FloorFlowMeasurement measured =
      flow_.measure(sights.flow, last_ ? last_->state : std::nullopt, sights.stamp_ns, rotation);
  result.flow = measured.outcome;
  result.flow_points = measured.inliers;
  result.flow_chi2 = measured.chi2_per_dof;
  result.flow_sighting = measured.sighting;
  if (measured.sighting) result.flow = filter_.add(*measured.sighting);
}

void FlightEstimator::use_markers(const HoverSights& sights, const KnownRotation& rotation,
                                  HoverFrame& result) {
  if (!markers_) {
    result.markers = Outcome::failure(Code::kNotAttempted, "there are no markers");
    return;
  }
  const auto span = times_.measure("markers");
  MarkerView view{sights.stamp_ns, sights.markers, sights.beacons, imu_.mean_force_body(),
                  std::nullopt};
  if (last_ && imu_.samples().size() > 1)
    view.turn_body = R_body_cam_ * rotation.R_1_2 * R_body_cam_.inverse();
  const BodyExpectation expectation = filter_.expectation(sights.stamp_ns);
  const bool restarts = !markers_->relies_on(expectation);
  const MarkerAnswer answer = markers_->estimate(view, expectation);
  result.markers = answer.outcome;
  if (!answer.outcome) return;
  result.markers_seen = answer.markers;
  result.beacons_seen = answer.beacons;
  result.pose_sighting = answer.sighting;
  if (restarts)
    result.markers = start_by(answer.sighting);
  else
    delayed_poses_.push(answer.sighting);
}

/// Starts, or starts anew, where markers are; the biases that the filter knows are kept.
Outcome FlightEstimator::start_by(const PoseSighting& pose) {
  if (!imu_.reaches(pose.stamp_ns, options_.filter.max_prediction_s))
    return Outcome::failure(Code::kTooFewData, "no inertial samples to begin with");
  start(start_state(pose, options_.start, filter_.expectation(pose.stamp_ns).state));
  return Outcome::ok();
}

/// Hands the filter the poses whose delay has passed; those older than its history it refuses.
Outcome FlightEstimator::deliver_poses(std::int64_t now_ns) {
  Outcome last = Outcome::ok();
  for (const PoseSighting& pose : delayed_poses_.take(now_ns)) last = filter_.add(pose);
  return last;
}

}  // namespace placegraph
