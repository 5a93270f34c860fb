#include <placegraph/pipeline/odometry/odometry.h>

#include <cmath>

namespace placegraph {
namespace {

/// Of a motion that is well enough to go on by, but not to begin with.
Outcome weakly_agrees(const DirectMotion& motion) {
  return Outcome::failure(Outcome::Code::kInconsistent,
                          "to begin with, correlation " + std::to_string(motion.agreement) +
                              " and a share of inliers of " + std::to_string(motion.inlier_share) +
                              " are too little");
}

}  // namespace

/// Two eyes and depth measure lengths at once, as does a surface at a known distance.
bool Odometry::metric_from_start() const {
  return calibration_.baseline_m > 0 || calibration_.depth ||
         (cues_.surfaces_alone() && calibration_.camera_height_m);
}

/// Surfaces are all that is followed: the first frame that shows one is the first keyframe.
OdometryUpdate Odometry::begin_on_surfaces(const Frame& frame) {
  OdometryUpdate update;
  const auto span = times_.measure("surfaces");
  Random random(seed_, frame.id);
  surfaces_->see(frame);
  if (!surfaces_->become_reference(SE3(), RectificationError(), {}, random)) {
    update.reason = "no surface to begin with";
    log(log_, LogLevel::kDebug, "frame {}: {}", frame.id, update.reason);
    surfaces_->reset();
    return update;
  }
  started_ = true;
  const std::int64_t id = next_keyframe_++;
  window_.add_keyframe(id, T_odom_start_);
  last_keyframe_ = id;
  if (manhattan_) look_at_directions(frame);
  refine_window();
  last_frame_ = frame;
  frames_since_keyframe_ = 0;
  newest_motion_ = DirectMotion();
  update.new_keyframes.push_back({id, frame});
  state_ = update.state = TrackingState::kTracking;
  update.T_odom_cam = T_odom_last_ = window_.pose(id);
  update.keyframe = id;
  return update;
}

/// Where the camera was going, from the last keyframe; a weak measurement of its own.
MotionGuess Odometry::expected_motion() const {
  MotionGuess guess;
  guess.T_ref_cur = window_.pose(last_keyframe_).inverse() * T_odom_last_ * T_last_cur_;
  if (!velocity_known_) return guess;
  constexpr double kSigmaRad = 0.03, kShare = 0.01, kShareOfWay = 0.5;
  const double sigma_m = kShare * median_depth_m_ + kShareOfWay * T_last_cur_.translation().norm();
  Vector6d sigmas;
  sigmas << Eigen::Vector3d::Constant(sigma_m), Eigen::Vector3d::Constant(kSigmaRad);
  guess.information = sigmas.cwiseAbs2().cwiseInverse().asDiagonal();
  return guess;
}

/// The newest frame's motion from the last keyframe: from where the velocity leads; else, and at
/// the start, what suits best of several ways to begin, of which a swarm finds one.
DirectMotion Odometry::align_surfaces() const {
  const MotionGuess guess = expected_motion();
  DirectMotion best;
  best.outcome = Outcome::failure(Outcome::Code::kNoConsensus, "no way to begin with suits");
  if (velocity_known_) {
    best = surfaces_->align(guess);
    if (best.outcome) return best;
  }
  constexpr double kReach = 0.12;  // of the depth, in one frame
  constexpr double kLeastAgreement = 0.75, kLeastInliers = 0.6;
  const double reach_m = kReach * median_depth_m_;
  Vector6d sigmas;
  sigmas << 0.3 * reach_m, 0.2 * reach_m, reach_m, 0.015, 0.025, 0.01;
  MotionGuess about{guess.T_ref_cur};
  about.information = sigmas.cwiseAbs2().cwiseInverse().asDiagonal();
  double best_score = 0, nearest = 0;
  const auto consider = [&](const DirectMotion& motion) {
    const double score = motion.agreement * motion.inlier_share * std::sqrt(motion.visible_share);
    if (!motion.outcome || motion.agreement < kLeastAgreement ||
        motion.inlier_share < kLeastInliers) {
      // What came nearest says why there is none, where the velocity led nowhere.
      if (velocity_known_ || best_score > 0 || !(score > nearest)) return;
      nearest = score;
      best.outcome = motion.outcome ? weakly_agrees(motion) : motion.outcome;
      return;
    }
    if (score <= best_score) return;
    best_score = score;
    best = motion;
  };
  for (const double share : {0.0, 0.5, 1.0, 1.5}) {
    MotionGuess start = about;
    start.T_ref_cur = about.T_ref_cur * SE3(SO3(), Eigen::Vector3d(0, 0, share * reach_m));
    consider(surfaces_->align(start));
  }
  consider(surfaces_->search(about, sigmas));
  return best;
}

/// Paper IV, 3.4: the surface of the keyframe is aligned with the frame; where little of it is
/// left, the frame becomes the next keyframe and its own surface is found. Where the surface is
/// lost, the last frame that was posed takes the keyframe's place, with a surface nearer by.
OdometryUpdate Odometry::track_surfaces(const Frame& frame) {
  const auto span = times_.measure("surfaces");
  OdometryUpdate update;
  Random random(seed_, frame.id);
  surfaces_->see(frame);
  DirectMotion motion = align_surfaces();
  if (!motion.outcome && frames_since_keyframe_ > 0) {
    log(log_, LogLevel::kDebug, "frame {}: from the last one, {}", frame.id, motion.outcome.reason);
    surfaces_->see(last_frame_);
    const bool nearer = add_surface_keyframe(last_frame_, newest_motion_, update);
    surfaces_->see(frame);
    if (nearer) motion = align_surfaces();
  }
  if (!motion.outcome) {
    log(log_, LogLevel::kInfo, "frame {} lost: {}", frame.id, motion.outcome.reason);
    update.reason = motion.outcome.reason;
    update.state = TrackingState::kLost;
    return update;
  }
  const SE3 T_odom_cam = window_.pose(last_keyframe_) * motion.T_ref_cur;
  T_last_cur_ = T_odom_last_.inverse() * T_odom_cam;
  velocity_known_ = true;
  T_odom_last_ = T_odom_cam;
  newest_motion_ = motion;
  last_frame_ = frame;
  ++frames_since_keyframe_;
  if (surface_keyframe_due(motion) && add_surface_keyframe(frame, motion, update))
    T_odom_last_ = window_.pose(last_keyframe_);
  update.state = TrackingState::kTracking;
  update.T_odom_cam = T_odom_last_;
  update.keyframe = last_keyframe_;
  update.inliers = static_cast<int>(motion.inlier_share * static_cast<double>(motion.seen.size()));
  return update;
}

/// Little of the surfaces is left, or they are seen at another size. A camera that stands keeps its
/// keyframe: there is nothing to gain by a new one.
bool Odometry::surface_keyframe_due(const DirectMotion& motion) const {
  const double way = motion.T_ref_cur.translation().norm() / median_depth_m_;
  const double turn_rad = motion.T_ref_cur.rotation().log().norm();
  constexpr double kFar = 0.3, kFarTurn_rad = 0.15, kStands = 0.02, kStandsTurn_rad = 0.01;
  if (way < kStands && turn_rad < kStandsTurn_rad) return false;
  return way > kFar || turn_rad > kFarTurn_rad ||
         motion.visible_share < options_.surfaces.keyframe_share ||
         motion.inlier_share < options_.surfaces.keyframe_share ||
         frames_since_keyframe_ >= options_.keyframe.max_interval;
}

/// The frame, which the surfaces have seen last, becomes a keyframe; false if it shows none.
bool Odometry::add_surface_keyframe(const Frame& frame, const DirectMotion& motion,
                                    OdometryUpdate& update) {
  Random random(seed_, frame.id);
  surfaces_->learn(motion);
  if (!surfaces_->become_reference(motion.T_ref_cur, RectificationError(), {}, random))
    return false;
  const DirectMotion believed = surfaces_->confirm(motion);
  const std::int64_t id = next_keyframe_++, previous = last_keyframe_;
  window_.add_keyframe(id, window_.pose(previous) * believed.T_ref_cur);
  window_.add_motion(
      {previous, id, believed.T_ref_cur, believed.covariance.ldlt().solve(Matrix6d::Identity())});
  log(log_, LogLevel::kDebug, "surfaces {}: t {:f} agreement {:f} visible {:f} inliers {:f}{}",
      frame.id, believed.T_ref_cur.translation().norm(), motion.agreement, motion.visible_share,
      motion.inlier_share, (believed.outcome ? "" : ", " + believed.outcome.reason));
  last_keyframe_ = id;
  if (manhattan_) look_at_directions(frame);
  refine_window();
  frames_since_keyframe_ = 0;
  update.new_keyframes.push_back({id, frame});
  return true;
}

/// The landmarks that are followed, as the newest keyframe sees them; they are believed to a few
/// percent of their depth.
std::vector<KnownPixel> Odometry::landmarks_seen(const SE3& T_odom_cam) const {
  constexpr double kSigmaShare = 0.03;
  const SE3 T_cam_odom = T_odom_cam.inverse();
  std::vector<KnownPixel> seen;
  for (const PointTrack& track : tracker_.tracks()) {
    const auto point = window_.landmark(track.id);
    if (!point) continue;
    const Eigen::Vector3d p_cam = T_cam_odom * *point;
    if (!(p_cam.z() > 0)) continue;
    seen.push_back({track.px, {p_cam / p_cam.z(), 1 / p_cam.z(), kSigmaShare / p_cam.z()}});
  }
  return seen;
}

/// Surfaces beside other cues: the motion between two keyframes by grey values goes into the
/// window. A single eye's height has given the unit already, and its landmarks are of the window:
/// of the motion's length it learns nothing more.
void Odometry::align_keyframes(const Frame& frame, std::int64_t previous) {
  newest_motion_ = DirectMotion();
  if (!scale_known_) return;
  const auto span = times_.measure("surfaces");
  Random random(seed_, frame.id);
  surfaces_->see(frame);
  surfaces_->restrict_ground(labelled_ground(frame));
  const SE3 T_odom_cam = window_.pose(last_keyframe_);
  SE3 T_ref_cur;
  if (previous >= first_keyframe_ && surfaces_->has_reference()) {
    T_ref_cur = window_.pose(previous).inverse() * T_odom_cam;
    newest_motion_ = surfaces_->align({T_ref_cur});
    if (newest_motion_.outcome) T_ref_cur = newest_motion_.T_ref_cur;
  }
  surfaces_->learn(newest_motion_);
  const bool found = surfaces_->become_reference(
      T_ref_cur, rectification_ ? rectification_->error() : RectificationError(),
      landmarks_seen(T_odom_cam), random);
  if (!newest_motion_.outcome) return;
  const DirectMotion both = found ? surfaces_->confirm(newest_motion_) : newest_motion_;
  if (!both.outcome) return;
  Matrix6d covariance = both.covariance;
  if (!metric_from_start()) {
    const Eigen::Vector3d t = both.T_ref_cur.rotation().inverse() * both.T_ref_cur.translation();
    covariance.topLeftCorner<3, 3>() += t * t.transpose();
  }
  window_.add_motion(
      {previous, last_keyframe_, both.T_ref_cur, covariance.ldlt().solve(Matrix6d::Identity())});
}

}  // namespace placegraph
