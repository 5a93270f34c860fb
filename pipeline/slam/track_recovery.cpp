#include <placegraph/graph/text/log_message.h>
#include <placegraph/pipeline/slam/track_recovery.h>

#include <Eigen/Cholesky>
#include <algorithm>

namespace placegraph {

SE3 KnownMap::T_map_frame(const LocatedFrame& located) const {
  return rigid_part(mapper.S_map_keyframe(located.match) * Sim3(located.T_match_query));
}

void TrackRecovery::use_motion(std::shared_ptr<const MeasuredMotion> motion_cam) {
  motion_ = std::move(motion_cam);
}

/// Location by the motion of other sensors since the last keyframe, if both are metric.
std::optional<LocatedFrame> TrackRecovery::by_motion(const Frame& frame,
                                                     const KnownMap& known) const {
  const auto last = known.recorder.newest_keyframe();
  if (!motion_ || !last || known.mapper.scale_unknown(*last, *last)) return std::nullopt;
  const auto since = motion_->between(known.recorder.stamp_ns_of(*last), frame.stamp_ns);
  if (!since) return std::nullopt;
  LocatedFrame located{*last, since->T_a_b};
  located.information.topLeftCorner<6, 6>() = since->covariance.ldlt().solve(Matrix6d::Identity());
  return located;
}

LocatedFrame turned(const LocatedFrame& before, const Matrix6d& covariance_before,
                    const PureRotation& rotation, double sigma_m) {
  const SE3 T_before_cam(rotation.R_before_cam, {0, 0, 0});
  const Matrix6d back = T_before_cam.inverse().adjoint();
  Matrix6d covariance = back * covariance_before * back.transpose();
  covariance.topLeftCorner<3, 3>().diagonal().array() += sigma_m * sigma_m;
  covariance.bottomRightCorner<3, 3>() += rotation.covariance;
  LocatedFrame located{before.match, before.T_match_query * T_before_cam};
  located.information.topLeftCorner<6, 6>() = covariance.ldlt().solve(Matrix6d::Identity());
  return located;
}

/// Location by the rotation of a monocular camera since the last keyframe, or since it was last
/// located.
std::optional<LocatedFrame> TrackRecovery::by_rotation(const OdometryUpdate& update,
                                                       const KnownMap& known,
                                                       double median_depth) const {
  const auto last = known.recorder.newest_keyframe();
  if (!update.rotation || !last) return std::nullopt;
  const double sigma_m = options_.rotation_rad * median_depth;
  if (!anchor_) return turned({*last, SE3()}, Matrix6d::Zero(), *update.rotation, sigma_m);
  const Matrix6d information = anchor_->information.topLeftCorner<6, 6>();
  const Matrix6d covariance = information.ldlt().solve(Matrix6d::Identity());
  return turned(*anchor_, covariance, *update.rotation, sigma_m);
}

OdometryUpdate TrackRecovery::handle(const Frame& frame, const KnownMap& known,
                                     Odometry& odometry) {
  continues_ = false;
  apart_ = std::max(0, apart_ - 1);
  const std::optional<LocatedFrame> before = locate_before(frame, known, odometry);
  OdometryUpdate update =
      odometry.add_frame(frame, before ? std::optional(known.T_map_frame(*before)) : std::nullopt);
  located_ = locate_after(before, update, known, odometry);
  if (must_restart(update, known)) update = restart(frame, update, known, odometry);
  if (update.state == TrackingState::kTracking) lost_in_a_row_ = apart_ = 0;
  return update;
}

/// Locates a frame before the odometry processes it; only while no segment is connected to the map.
std::optional<LocatedFrame> TrackRecovery::locate_before(const Frame& frame, const KnownMap& known,
                                                         Odometry& odometry) {
  if (anchor_) {
    // A monocular camera that restarts within the map waits for its second view; until then every
    // frame is relocalized.
    const auto recognized = known.closer.relocalize(frame);
    return recognized ? recognized : by_motion(frame, known);
  }
  if (lost_in_a_row_ < options_.max_lost_frames || odometry.started()) return std::nullopt;
  // No first view has been found yet: each frame is located by the other sensors.
  anchor_ = by_motion(frame, known);
  if (anchor_) odometry.restart(known.T_map_frame(*anchor_), true);
  return anchor_;
}

/// Locates a frame after the odometry has processed it and may have found a pure rotation.
std::optional<LocatedFrame> TrackRecovery::locate_after(const std::optional<LocatedFrame>& before,
                                                        const OdometryUpdate& update,
                                                        const KnownMap& known,
                                                        const Odometry& odometry) {
  if (!anchor_) return before;
  const std::optional<LocatedFrame> located =
      before ? before : by_rotation(update, known, odometry.map().median_depth());
  if (update.reference) anchor_ = located;
  return located;
}

/// Whether the frame has no pose and is not one with which a segment begins.
bool TrackRecovery::must_restart(const OdometryUpdate& update, const KnownMap& known) const {
  if (update.state == TrackingState::kLost) return true;
  const bool mapped = known.recorder.newest_keyframe().has_value();
  return update.state == TrackingState::kInitializing && mapped && !anchor_ && apart_ == 0;
}

/// Restarts tracking if the frame can be located; otherwise returns the update unchanged.
OdometryUpdate TrackRecovery::restart(const Frame& frame, const OdometryUpdate& update,
                                      const KnownMap& known, Odometry& odometry) {
  ++lost_in_a_row_;
  const auto located = located_ ? located_ : known.closer.relocalize(frame);
  if (located) {
    log(log_, LogLevel::kInfo, "frame {} relocalized at frame {}", frame.id,
        known.recorder.frame_of(located->match));
    anchor_ = located;
    // The segment's odometry frame is the current map frame.
    const SE3 T_map_frame = known.T_map_frame(*located);
    odometry.restart(T_map_frame, true);
    return odometry.add_frame(frame, T_map_frame);
  }
  const double median_depth = odometry.map().median_depth();
  if (!anchor_ && update.state == TrackingState::kLost)
    if ((anchor_ = by_rotation(update, known, median_depth))) {
      log(log_, LogLevel::kInfo, "frame {}: pure rotation", frame.id);
      const double scale = known.mapper.S_map_keyframe(anchor_->match).scale();
      odometry.restart(known.T_map_frame(*anchor_), false, scale * median_depth);
      return odometry.add_frame(frame);
    }
  anchor_.reset();
  if (lost_in_a_row_ != options_.max_lost_frames) return update;
  if ((anchor_ = by_motion(frame, known))) {
    log(log_, LogLevel::kInfo, "frame {}: continued by measured motion", frame.id);
    const SE3 T_map_frame = known.T_map_frame(*anchor_);
    odometry.restart(T_map_frame, true);
    const OdometryUpdate begun = odometry.add_frame(frame, T_map_frame);
    if (!odometry.started()) anchor_.reset();
    return begun;
  }
  begin_component(frame.id, odometry);
  return odometry.add_frame(frame);
}

void TrackRecovery::begin_component(FrameId frame, Odometry& odometry) {
  log(log_, LogLevel::kInfo, "frame {}: a new component of the map begins", frame);
  anchor_.reset();
  odometry.restart(T_map_last_);
}

void TrackRecovery::begin_apart(FrameId frame, Odometry& odometry) {
  begin_component(frame, odometry);
  apart_ = options_.max_lost_frames + 1;  // the next frame is the first
}

std::optional<LocatedFrame> TrackRecovery::pose_without_tracking(const Frame& frame,
                                                                 const OdometryUpdate& update,
                                                                 const KnownMap& known,
                                                                 const Odometry& odometry) {
  const bool initializing = update.state == TrackingState::kInitializing;
  if (!anchor_ || !initializing || (!located_ && lost_in_a_row_ == 0))
    return by_motion(frame, known);
  const LocatedFrame at = located_ ? *located_ : *anchor_;
  if (motion_ && !odometry.started()) anchor_.reset();
  if (located_ || update.reference) return at;
  return std::nullopt;
}

void TrackRecovery::take_up(KeyframeId newest, double median_depth, const KnownMap& known) {
  // Chosen: far below any measurement, as the pose is that of the keyframe itself.
  constexpr double kSigmaDepths = 1e-5, kSigmaRad = 1e-5;
  const double sigma = kSigmaDepths * median_depth;
  anchor_ = LocatedFrame{newest, SE3()};
  anchor_->information.diagonal().head<3>().setConstant(1 / (sigma * sigma));
  anchor_->information.diagonal().segment<3>(3).setConstant(1 / (kSigmaRad * kSigmaRad));
  continues_ = true;
  T_map_last_ = known.T_map_frame(*anchor_);
}

std::optional<PlaceMapper::Link> TrackRecovery::take_link(const LocalMap& map,
                                                          const PlaceMapper& mapper) {
  /// Standard deviation of the scale that a segment takes from frames recognized in the map
  /// (logarithm), and of a guessed scale, which assumes that the scene after a rotation is about as
  /// far away as before.
  constexpr double kSigmaLogScaleOfMap = 0.1, kSigmaLogScaleGuessed = 0.7;
  if (!anchor_) return std::nullopt;
  // The new segment has the scale of the map, the match possibly another one.
  const double sigma_log_scale = map.metric()                     ? 0
                                 : map.scale() == Scale::kGuessed ? kSigmaLogScaleGuessed
                                                                  : kSigmaLogScaleOfMap;
  const bool same_segment = continues_ && map.metric();
  const PlaceMapper::Link link{
      anchor_->match,
      anchor_->T_match_query,
      anchor_->information.topLeftCorner<6, 6>(),
      same_segment ? ConstraintSource::kOdometry : ConstraintSource::kOther,
      sigma_log_scale,
      same_segment ? 1 : 1 / mapper.S_map_keyframe(anchor_->match).scale()};
  anchor_.reset();
  return link;
}

}  // namespace placegraph
