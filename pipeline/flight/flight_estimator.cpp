#include <placegraph/frontend/flow/flow_vector.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/time.h>
#include <placegraph/pipeline/flight/flight_estimator.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Code = Outcome::Code;

constexpr int kEnoughMarkers = 3;  // with so many, beacons are not looked for
constexpr double kKept = 0.7;      // of the tracks: with fewer, new ones are looked for
constexpr int kPatience = 5;       // images between two that are searched for corners in vain

/// Of the state's pose, right tangent.
Matrix6d pose_covariance(const BodyState& state) {
  constexpr int kPart[] = {0, 6};  // position (world) and attitude in the state
  Matrix6d covariance;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      covariance.block<3, 3>(3 * i, 3 * j) = state.covariance.block<3, 3>(kPart[i], kPart[j]);
  Matrix6d J = Matrix6d::Identity();
  J.topLeftCorner<3, 3>() = state.T_world_body.rotation().matrix().transpose();
  return J * covariance * J.transpose();
}

}  // namespace

void visit(OptionVisitor& field, HoverStartOptions& o) {
  field("velocity_sigma_mps", o.velocity_sigma_mps, "of a body that begins, each axis",
        {1e-3, 100});
  field("gyro_bias_sigma", o.gyro_bias_sigma, "rad/s, before anything is known of it", {1e-6, 1});
  field("accel_bias_sigma", o.accel_bias_sigma, "m/s^2, likewise", {1e-6, 10});
}

void visit(OptionVisitor& field, HoverOptions& o) {
  field("floor_z_m", o.floor_z_m, "height of the floor in the world", {-1e6, 1e6});
  field("flow_noise_px", o.flow_noise_px,
        "of a followed point, beside what the image's noise makes", {0, 10});
  field("flow_common_px", o.flow_common_px, "what all points of an image pair err alike", {0, 10});
  field("min_flow_points", o.min_flow_points, "with fewer, flow says nothing", {6, 10000});
  field("use_flow", o.use_flow, "whether flow over the floor is heeded");
  field("marker_delay_s", o.marker_delay_s, "poses by markers come so much after their image",
        {0, 60});
  field("max_markers", o.max_markers, "looked for where more are expected: the largest", {1, 1000});
  field("restart_after", o.restart_after,
        "images in a row whose markers contradict the filter, until it begins anew", {1, 100000});
  field("search_interval", o.search_interval,
        "images without a believed marker, until one is searched whole", {1, 1000});
  field.group("detector", o.detector, "how markers are found");
  field.group("beacons", o.beacons, "how beacons are found");
  field.group("markers", o.markers, "how markers and beacons become poses");
  field.group("tracker", o.tracker, "corners of the floor that are followed");
  field.group("start", o.start, "what a body that begins does not know");
  field.group("filter", o.filter, "how the sensors err, and what is believed");
  field("map_interval_s", o.map_interval_s,
        "between images that are searched whole for markers to be mapped", {0, 60});
  field.group("map", o.map, "markers whose place is not known");
}

void HoverOptions::check() const { check_ranges(*this); }

Hover::Hover(const HoverOptions& options, const Camera& camera, const SE3& T_body_cam,
             const MarkerLayout& layout)
    : options_(options),
      camera_(camera),
      T_body_cam_(T_body_cam),
      tracker_(options.tracker),
      beacons_world_(layout.beacons_world),
      filter_(options.filter, T_body_cam, options.floor_z_m) {
  options_.check();
  camera_.check();
  if (!layout.markers.empty()) detector_.emplace(options_.detector, layout.dictionary);
  if (detector_ || !beacons_world_.empty())
    markers_.emplace(options_.markers, layout, camera, T_body_cam);
}

void Hover::start(const BodyState& state) {
  filter_.start(state);
  on_the_way_.clear();
  previous_.reset();
  for (const ImuSample& sample : samples_)
    if (sample.stamp_ns > state.stamp_ns) (void)filter_.add(sample);
}

Outcome Hover::add(const ImuSample& sample) {
  if (!sample.gyro_rad_s.allFinite() || !sample.accel_m_s2.allFinite())
    return Outcome::failure(Code::kInconsistent, "the inertial sample is not finite");
  if (!samples_.empty() && sample.stamp_ns <= samples_.back().stamp_ns)
    return Outcome::failure(Code::kInconsistent, "the inertial sample is not after the last one");
  samples_.push_back(sample);
  return filter_.started() ? filter_.add(sample)
                           : Outcome::failure(Code::kNotAttempted, "no marker was seen yet");
}

/// The camera's turn by the gyro, its noise and what is not known of its bias.
KnownRotation Hover::turn_between(std::int64_t from_ns, std::int64_t to_ns) const {
  const Vector3d bias = previous_ ? previous_->gyro_bias : Vector3d::Zero();
  SO3 R_from_now;
  for (std::size_t i = 0; i + 1 < samples_.size(); ++i) {
    const ImuSample &a = samples_[i], &b = samples_[i + 1];
    const std::int64_t begin = std::max(a.stamp_ns, from_ns), end = std::min(b.stamp_ns, to_ns);
    if (end <= begin) continue;
    const double middle = seconds(a.stamp_ns, begin + (end - begin) / 2);
    const double share = middle / seconds(a.stamp_ns, b.stamp_ns);
    const Vector3d rate = (1 - share) * a.gyro_rad_s + share * b.gyro_rad_s - bias;
    R_from_now = R_from_now * SO3::exp(seconds(begin, end) * rate);
  }
  const SO3 R_cam_body = T_body_cam_.rotation().inverse();
  const double dt = seconds(from_ns, to_ns), noise = options_.filter.gyro_noise;
  Matrix3d covariance = noise * noise * dt * Matrix3d::Identity();
  if (previous_) covariance += dt * dt * previous_->covariance.block<3, 3>(9, 9);
  return {R_cam_body * R_from_now * R_cam_body.inverse(),
          R_cam_body.matrix() * covariance * R_cam_body.matrix().transpose()};
}

/// Where the points of the floor that are followed should be next.
std::vector<Eigen::Vector2f> Hover::predicted_tracks(const BodyState& next) const {
  const SE3 T_world_1 = previous_->T_world_body * T_body_cam_;
  const SE3 T_2_world = (next.T_world_body * T_body_cam_).inverse();
  std::vector<Eigen::Vector2f> predicted;
  for (const PointTrack& track : tracker_.tracks()) {
    predicted.push_back(track.px);
    const auto ray_cam = camera_.unproject(track.px.cast<double>());
    if (!ray_cam) continue;
    const Vector3d ray = T_world_1.rotation() * *ray_cam;
    const double depth = (options_.floor_z_m - T_world_1.translation().z()) / ray.z();
    if (!(depth > 0)) continue;
    const auto px = camera_.project(T_2_world * Vector3d(T_world_1.translation() + depth * ray));
    if (px && camera_.contains(*px)) predicted.back() = px->cast<float>();
  }
  return predicted;
}

std::vector<FlowVector> Hover::follow(const Frame& frame) {
  const auto expected = filter_.at(frame.stamp_ns);
  const bool foreseen = previous_ && expected.outcome && !tracker_.tracks().empty();
  std::vector<FlowVector> vectors;
  {
    const auto span = times_.measure("track");
    tracker_.track(frame.image,
                   foreseen ? predicted_tracks(expected.state) : std::vector<Eigen::Vector2f>(),
                   foreseen ? PointTracker::Search::kNear : PointTracker::Search::kWide);
    const double noise_grey = image_noise(frame.image);
    const double least = options_.flow_noise_px * options_.flow_noise_px;
    for (const PointTrack& track : tracker_.tracks()) {
      FlowVector vector;
      vector.kind = FlowVector::Kind::kFull;
      vector.px = track.px_previous.cast<double>();
      vector.flow = (track.px - track.px_previous).cast<double>();
      vector.covariance = track_covariance(frame.image, track.px.cast<double>(),
                                           options_.tracker.window_px, noise_grey) +
                          least * Eigen::Matrix2d::Identity();
      vectors.push_back(vector);
    }
  }
  // Where the floor offers few corners, looking for more in every image finds none.
  const auto left = static_cast<double>(tracker_.tracks().size());
  ++since_detection_;
  if (left < kKept * options_.tracker.max_tracks &&
      since_detection_ >= (left < kKept * static_cast<double>(detected_) ? 2 : kPatience)) {
    const auto span = times_.measure("detect corners");
    tracker_.detect();
    detected_ = tracker_.tracks().size();
    since_detection_ = 0;
  }
  return vectors;
}

void Hover::take_flow(const HoverSights& sights, HoverFrame& result) {
  const auto span = times_.measure("flow");
  if (!previous_) {
    result.flow = Outcome::failure(Code::kNotAttempted, "the last image has no state");
    return;
  }
  const KnownRotation turn = turn_between(previous_->stamp_ns, sights.stamp_ns);
  const SO3 R_cam_world = (previous_->T_world_body * T_body_cam_).rotation().inverse();
  const VentralMotion motion =
      ventral_motion(derotate(camera_, sights.flow, turn), R_cam_world * -Vector3d::UnitZ());
  result.flow = motion.outcome;
  result.flow_points = motion.inliers;
  result.flow_chi2 = motion.chi2_per_dof;
  if (motion.outcome && motion.inliers < options_.min_flow_points)
    result.flow = Outcome::failure(Code::kTooFewData,
                                   std::to_string(motion.inliers) + " points of the floor");
  if (!result.flow || !options_.use_flow) return;
  const double common = options_.flow_common_px / camera_.fx;
  const FlowSighting sighting{
      previous_->stamp_ns,  sights.stamp_ns,
      motion.over_distance, motion.covariance + common * common * Matrix3d::Identity(),
      motion.J_rotation,    turn.R_1_2,
      previous_->gyro_bias};
  result.flow_sighting = sighting;
  result.flow = filter_.add(sighting);
}

/// Whether any beacon may be in the image, at its edge too.
bool Hover::beacons_in_view(const BodyState& state) const {
  constexpr double kEdge_px = 40;
  const SE3 T_cam_world = (state.T_world_body * T_body_cam_).inverse();
  return std::any_of(beacons_world_.begin(), beacons_world_.end(), [&](const Vector3d& beacon) {
    const auto px = camera_.project(T_cam_world * beacon);
    return px && camera_.contains(*px, -kEdge_px);
  });
}

/// The largest of the squares that should be in view.
std::vector<ExpectedSquare> Hover::largest_expected(const BodyState& state) const {
  std::vector<ExpectedSquare> squares =
      markers_->expected_squares(state.T_world_body, pose_covariance(state));
  const auto diagonal2 = [](const ExpectedSquare& square) {
    const SquareCorners& px = square.corners_px;
    return (px[2] - px[0]).squaredNorm() + (px[3] - px[1]).squaredNorm();
  };
  std::stable_sort(squares.begin(), squares.end(),
                   [&](const ExpectedSquare& a, const ExpectedSquare& b) {
                     return diagonal2(a) > diagonal2(b);
                   });
  if (static_cast<int>(squares.size()) > options_.max_markers)
    squares.resize(static_cast<std::size_t>(options_.max_markers));
  // What markers contradict is not as sure as it says.
  if (contradicted_ > 0)
    for (ExpectedSquare& square : squares) square.within_px.reset();
  return squares;
}

/// Markers around where they should be; before the start, and now and then where none has been
/// believed for a while, everywhere. Beacons where markers are few.
void Hover::look_for_marks(const Frame& frame, HoverSights& sights) {
  const auto expected = filter_.at(frame.stamp_ns);
  const bool everywhere = !expected.outcome || ++since_search_ >= options_.search_interval;
  if (everywhere) since_search_ = 0;
  if (detector_) {
    const auto span = times_.measure("detect markers");
    sights.markers = everywhere
                         ? detector_->detect(frame.image)
                         : detector_->detect_near(frame.image, largest_expected(expected.state));
  }
  if (!beacons_world_.empty() && static_cast<int>(sights.markers.size()) < kEnoughMarkers &&
      (everywhere || beacons_in_view(expected.state))) {
    const auto span = times_.measure("detect beacons");
    sights.beacons = detect_beacons(frame.image, options_.beacons);
  }
}

/// Mean specific force since the last image.
Vector3d Hover::mean_force() const {
  Vector3d sum = Vector3d::Zero();
  for (const ImuSample& sample : samples_) sum += sample.accel_m_s2;
  return sum / static_cast<double>(samples_.size());
}

/// Position and attitude as the first markers have them; the rest is hardly known.
void Hover::begin(const PoseSighting& sighting) {
  BodyState state;
  state.stamp_ns = sighting.stamp_ns;
  state.T_world_body = sighting.T_world_body;
  // The tangent's translation is in the body's axes, the state's in the world's.
  Matrix6d J = Matrix6d::Identity();
  J.topLeftCorner<3, 3>() = sighting.T_world_body.rotation().matrix();
  const Matrix6d pose = J * sighting.covariance * J.transpose();
  constexpr int kPart[] = {0, 6};  // position and attitude in the state
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      state.covariance.block<3, 3>(kPart[i], kPart[j]) = pose.block<3, 3>(3 * i, 3 * j);
  const auto vary = [&](int at, double sigma) {
    state.covariance.diagonal().segment<3>(at).setConstant(sigma * sigma);
  };
  vary(3, options_.start.velocity_sigma_mps);
  vary(9, options_.start.gyro_bias_sigma);
  vary(12, options_.start.accel_bias_sigma);
  const PositionFilter::Answer before = filter_.at(sighting.stamp_ns);
  if (before.outcome) {  // what it knows of its sensors stays
    state.gyro_bias = before.state.gyro_bias;
    state.accel_bias = before.state.accel_bias;
    state.covariance.bottomRightCorner<6, 6>() = before.state.covariance.bottomRightCorner<6, 6>();
  }
  start(state);
}

void Hover::take_marks(const HoverSights& sights, HoverFrame& result) {
  if (!markers_) {
    result.markers = Outcome::failure(Code::kNotAttempted, "there are no markers");
    return;
  }
  const auto span = times_.measure("markers");
  MarkerView view{sights.stamp_ns, sights.markers, sights.beacons, std::nullopt, std::nullopt};
  if (!samples_.empty()) view.force_body = mean_force();
  if (previous_ns_ > 0 && samples_.size() > 1) {
    const SO3 R_body_cam = T_body_cam_.rotation();
    view.turn_body =
        R_body_cam * turn_between(previous_ns_, sights.stamp_ns).R_1_2 * R_body_cam.inverse();
  }
  // Whoever is contradicted persistently is not asked any more.
  const BodyExpectation expectation = filter_.expectation(sights.stamp_ns);
  const bool expected = expectation.state && contradicted_ < options_.restart_after;
  const MarkerAnswer answer = markers_->observe(view, expected ? &expectation : nullptr);
  result.markers = answer.outcome;
  if (!answer.outcome) return;
  result.markers_seen = answer.markers;
  result.beacons_seen = answer.beacons;
  result.pose_sighting = answer.sighting;
  if (expected) {
    on_the_way_.push_back(answer.sighting);
    return;
  }
  const double newest = samples_.empty() ? -1 : seconds(samples_.back().stamp_ns, sights.stamp_ns);
  if (samples_.empty() || newest > options_.filter.max_prediction_s)
    result.markers = Outcome::failure(Code::kTooFewData, "no inertial samples to begin with");
  else
    begin(answer.sighting);
}

/// Hands the filter what has come by now; later than its history reaches, it will not have it.
Outcome Hover::deliver(std::int64_t now_ns) {
  Outcome last = Outcome::ok();
  while (!on_the_way_.empty() &&
         seconds(on_the_way_.front().stamp_ns, now_ns) >= options_.marker_delay_s) {
    last = filter_.add(on_the_way_.front());
    on_the_way_.pop_front();
  }
  return last;
}

HoverFrame Hover::add(const Frame& frame, bool markers_visible) {
  require(frame.image.cols == camera_.width && frame.image.rows == camera_.height,
          "Hover: the image has not the camera's size");
  HoverSights sights;
  sights.stamp_ns = frame.stamp_ns;
  sights.flow = follow(frame);
  if (markers_visible) look_for_marks(frame, sights);
  return add(sights);
}

HoverFrame Hover::add(const HoverSights& sights) {
  require(sights.stamp_ns > previous_ns_, "Hover: the image is not after the last one");
  HoverFrame result;
  result.stamp_ns = sights.stamp_ns;
  take_flow(sights, result);
  take_marks(sights, result);
  const Outcome delivered = deliver(sights.stamp_ns);
  if (result.markers && !delivered) result.markers = delivered;
  if (result.markers)
    contradicted_ = since_search_ = 0;
  else if (!sights.markers.empty() && result.markers.code == Code::kInconsistent)
    ++contradicted_;
  const PositionFilter::Answer answer = filter_.at(sights.stamp_ns);
  result.outcome = answer.outcome;
  result.state = answer.state;
  previous_.reset();
  if (answer.outcome) previous_ = answer.state;
  previous_ns_ = sights.stamp_ns;
  while (samples_.size() > 1 && samples_[1].stamp_ns <= sights.stamp_ns) samples_.pop_front();
  return result;
}

}  // namespace placegraph
