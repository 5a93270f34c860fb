#include <placegraph/graph/text/log_message.h>
#include <placegraph/pipeline/odometry/odometry.h>
#include <placegraph/pipeline/odometry/odometry_parts.h>
#include <placegraph/pipeline/tracking/cue_list.h>

namespace placegraph {

Odometry::Odometry(const OdometryOptions& options, const Calibration& calibration,
                   std::uint64_t seed, LogSink log, StageTimes& times)
    : options_((options.check(), options)),
      calibration_((calibration.check(), calibration)),
      log_(std::move(log)),
      times_(times),
      mapping_(options, calibration, log_, times),
      map_(make_local_map(options, calibration, mapping_.scale().available())) {
  auto [tracker, initializer] = make_tracker(options, calibration, seed, log_, times);
  tracker_ = std::move(tracker);
  initializer_ = std::move(initializer);
}

OdometryUpdate Odometry::add_frame(const Frame& frame, const std::optional<SE3>& T_odom_cam_known) {
  OdometryUpdate update = map_.empty() ? initialize(frame, T_odom_cam_known) : track(frame);
  lost_ = update.state == TrackingState::kLost;
  if (lost_) motion_.forget_velocity();
  if (update.state != TrackingState::kTracking) return update;
  update.T_odom_cam = motion_.T_odom_cam();
  update.keyframe = map_.newest();
  return update;
}

OdometryUpdate Odometry::track(const Frame& frame) {
  const auto span = times_.measure(tracker_->stage());
  OdometryUpdate update;

  // 1. Pose the frame against the local map, starting at the prediction of the motion model.
  TrackedFrame tracked = tracker_->track(frame, map_, motion_);
  if (!tracked.outcome)
    if (const auto last = tracker_->keyframe_to_retry_from();
        last && add_keyframe(*last, motion_.T_odom_cam(), update))
      tracked = tracker_->track(frame, map_, motion_);
  update.state = tracked.outcome ? TrackingState::kTracking : TrackingState::kLost;
  update.outcome = tracked.outcome;
  update.inliers = tracked.inliers;
  update.agreement = tracked.agreement;
  update.contradicted = tracked.contradicted;
  if (!tracked.outcome) {
    log(log_, LogLevel::kInfo, "frame {} lost: {}", frame.id, tracked.outcome.reason);
    update.rotation = tracked.rotation;
    return update;
  }
  motion_.update(tracked.T_odom_cam);
  map_.add_frame(frame.stamp_ns, tracked.T_odom_cam);

  // 2. If it shows enough new content, the frame becomes a keyframe and is added to the map.
  if (tracked.keyframe_due && add_keyframe(frame, tracked.T_odom_cam, update))
    motion_.correct(map_.pose(map_.newest()));
  if (update.rescale) motion_.rescale_velocity(update.rescale->factor);
  return update;
}

bool Odometry::add_keyframe(const Frame& frame, const SE3& T_odom_cam, OdometryUpdate& update) {
  const auto added = mapping_.add(frame, T_odom_cam, *tracker_, map_);
  if (!added) return false;
  update.new_keyframes.push_back(added->keyframe);
  update.posed_again = added->posed_again;
  update.rescale = added->rescale;
  return true;
}

OdometryUpdate Odometry::initialize(const Frame& frame,
                                    const std::optional<SE3>& T_odom_cam_known) {
  const Initialization start = initializer_->add(frame, T_odom_cam_known, map_, mapping_);
  if (start.state == TrackingState::kTracking)
    motion_ = MotionModel(map_.pose(map_.newest()), start.T_last_cur);
  return start.update();
}

void Odometry::restart(const SE3& T_odom_cam, bool in_known_map,
                       const std::optional<double>& median_depth) {
  const Scale scale =
      scale_at_start(options_, calibration_, in_known_map, median_depth.has_value());
  map_.restart(scale, in_known_map ? std::optional(map_.median_depth())
                                   : median_depth.value_or(LocalMap::kUnknownDepth));
  tracker_->reset();
  mapping_.scale().reset();
  initializer_->restart(T_odom_cam);
  motion_ = MotionModel(T_odom_cam);
  lost_ = false;
}

void Odometry::set_motion(std::shared_ptr<const MeasuredMotion> motion_cam) {
  if (map_.metric()) return;
  mapping_.scale().use_motion(std::move(motion_cam));
  map_ = make_local_map(options_, calibration_, mapping_.scale().available());
}

void Odometry::set_scene(std::shared_ptr<const SurfaceLabeller> labeller, bool masks) {
  // Surfaces that are tracked by their intensities alone are not masked.
  if (!parse_cues(options_.cues).without_features())
    mapping_.masks().set_model(std::move(labeller), masks);
}

void Odometry::assume(const std::optional<Assumptions>& assumptions) {
  mapping_.assume(assumptions);
  tracker_->assume(assumptions);
}

bool Odometry::awaits_scale() const {
  const bool arbitrary = map_.scale() == Scale::kArbitrary || map_.scale() == Scale::kGuessed;
  return !map_.empty() && arbitrary && mapping_.scale().uses_floor_lines();
}

std::vector<Eigen::Vector3d> Odometry::points_cam() const {
  const SE3 T_cam_odom = motion_.T_odom_cam().inverse();
  std::vector<Eigen::Vector3d> points = tracker_->points_odom(map_);
  for (Eigen::Vector3d& point : points) point = T_cam_odom * point;
  return points;
}

std::vector<LineFeature> Odometry::line_features() const {
  const LineCue* lines = tracker_->lines();
  return lines ? lines->features(map_.window(), motion_.T_odom_cam()) : std::vector<LineFeature>();
}

FrameView Odometry::view() const {
  if (lost_) return {};
  FrameView view = tracker_->view(map_, motion_.T_odom_cam());
  if (map_.metric()) view.ground_px = mapping_.scale().ground_outline_px();
  return view;
}

}  // namespace placegraph
