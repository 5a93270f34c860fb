#include <placegraph/frontend/align/direct_motion.h>
#include <placegraph/graph/text/log_message.h>
#include <placegraph/pipeline/tracking/cue_list.h>
#include <placegraph/pipeline/tracking/direct_tracker.h>

#include <Eigen/Cholesky>
#include <cmath>

namespace placegraph {
namespace {

/// Failure of a motion that is accurate enough for tracking, but not for the first alignment.
Outcome agrees_weakly(const DirectMotion& motion) {
  return Outcome::failure(Outcome::Code::kInconsistent,
                          "for the first alignment, correlation " +
                              std::to_string(motion.agreement) + " and a share of inliers of " +
                              std::to_string(motion.inlier_share) + " are too low");
}

/// The best of several alignments with a reference when the velocity may be unknown.
class BestAlignment {
 public:
  /// `failure`: result of an earlier attempt. `explain`: whether the best failure provides the
  /// reason.
  BestAlignment(DirectMotion failure, bool explain)
      : best_(std::move(failure)), explain_(explain) {}

  void consider(const DirectMotion& motion) {
    // Correlation and share of inliers of a motion that is accepted. Chosen.
    constexpr double kLeastAgreement = 0.75, kLeastInliers = 0.6;
    const double score = motion.agreement * motion.inlier_share * std::sqrt(motion.visible_share);
    if (!motion.outcome || motion.agreement < kLeastAgreement ||
        motion.inlier_share < kLeastInliers) {
      if (!explain_ || score_ > 0 || !(score > nearest_)) return;
      nearest_ = score;
      best_.outcome = motion.outcome ? agrees_weakly(motion) : motion.outcome;
    } else if (score > score_) {
      score_ = score;
      best_ = motion;
    }
  }
  const DirectMotion& best() const { return best_; }

 private:
  DirectMotion best_;
  bool explain_;
  double score_ = 0, nearest_ = 0;
};

}  // namespace

DirectTracker::DirectTracker(const OdometryOptions& options, const Calibration& calibration,
                             std::uint64_t seed, LogSink log, StageTimes& times)
    : options_(options.direct),
      max_interval_(options.keyframe.max_interval),
      seed_(seed),
      log_(std::move(log)),
      times_(times),
      direct_(options.direct, calibration, options.stereo, parse_cues(options.cues).direct) {
  if (parse_cues(options.cues).manhattan)
    manhattan_.emplace(options.manhattan, calibration.camera, seed, log_);
}

void DirectTracker::reset() {
  direct_.reset();
  seen_.reset();
  if (manhattan_) manhattan_->reset();
  newest_ = DirectMotion();
  from_before_.reset();
  frames_since_keyframe_ = 0;
}

void DirectTracker::see(const Frame& frame) {
  if (seen_ == frame.id) return;
  direct_.see(frame);
  seen_ = frame.id;
}

/// Aligns from the prediction of the motion model; if that fails, and at the start, takes the best
/// of several initial translations ahead, one of which is found by a particle swarm.
DirectMotion DirectTracker::align(const LocalMap& map, const MotionModel& motion) const {
  constexpr MotionModel::Uncertainty kUncertainty{0.01, 0.5, 0.03};
  constexpr double kReach = 0.12;  // share of the depth, in one frame
  MotionGuess guess;
  guess.T_ref_cur =
      map.window().pose(map.newest()).inverse() * motion.T_odom_cam() * motion.T_last_cur();
  DirectMotion by_velocity;
  by_velocity.outcome = Outcome::failure(Outcome::Code::kNoConsensus, "no initial motion fits");
  if (motion.velocity_known()) {
    guess.information = motion.information(kUncertainty, map.median_depth());
    by_velocity = direct_.align(guess);
    if (by_velocity.outcome) return by_velocity;
  }
  const double reach = kReach * map.median_depth();
  Vector6d sigmas;
  sigmas << 0.3 * reach, 0.2 * reach, reach, 0.015, 0.025, 0.01;
  MotionGuess about{guess.T_ref_cur};
  about.information = sigmas.cwiseAbs2().cwiseInverse().asDiagonal();
  BestAlignment alignment(by_velocity, !motion.velocity_known());
  for (const double share : {0.0, 0.5, 1.0, 1.5}) {
    MotionGuess start = about;
    start.T_ref_cur = about.T_ref_cur * SE3(SO3(), Eigen::Vector3d(0, 0, share * reach));
    alignment.consider(direct_.align(start));
  }
  alignment.consider(direct_.search(about, sigmas));
  return alignment.best();
}

TrackedFrame DirectTracker::track(const Frame& frame, const LocalMap& map,
                                  const MotionModel& motion) {
  see(frame);
  const DirectMotion aligned = align(map, motion);
  TrackedFrame tracked;
  tracked.outcome = aligned.outcome;
  if (!aligned.outcome) {
    if (frames_since_keyframe_ > 0)
      log(log_, LogLevel::kDebug, "frame {}: from the last one, {}", frame.id,
          aligned.outcome.reason);
    return tracked;
  }
  tracked.T_odom_cam = map.window().pose(map.newest()) * aligned.T_ref_cur;
  tracked.inliers =
      static_cast<int>(aligned.inlier_share * static_cast<double>(aligned.seen.size()));
  tracked.agreement = aligned.inlier_share;
  newest_ = aligned;
  last_frame_ = frame;
  ++frames_since_keyframe_;
  tracked.keyframe_due = keyframe_due(aligned, map.median_depth());
  return tracked;
}

std::optional<Frame> DirectTracker::keyframe_to_retry_from() const {
  if (frames_since_keyframe_ == 0) return std::nullopt;
  return last_frame_;
}

/// Whether a small part of the surfaces remains visible, or their size has changed. A stationary
/// camera keeps its keyframe, because a new one provides no benefit.
bool DirectTracker::keyframe_due(const DirectMotion& motion, double median_depth) const {
  const double length = motion.T_ref_cur.translation().norm() / median_depth;
  const double angle_rad = motion.T_ref_cur.rotation().log().norm();
  // Shares of the median depth and angles from which a keyframe is due, and below which the camera
  // stands still. Chosen.
  constexpr double kFar = 0.3, kFarRad = 0.15, kStands = 0.02, kStandsRad = 0.01;
  if (length < kStands && angle_rad < kStandsRad) return false;
  return length > kFar || angle_rad > kFarRad || motion.visible_share < options_.keyframe_share ||
         motion.inlier_share < options_.keyframe_share || frames_since_keyframe_ >= max_interval_;
}

std::optional<SE3> DirectTracker::prepare_keyframe(const KeyframeImages& images,
                                                   const SE3& T_odom_cam, const LocalMap& map) {
  Random random(seed_, "surfaces alone", {images.frame.id.value()});
  see(images.frame);
  from_before_.reset();
  if (map.empty()) {
    if (!direct_.become_reference(SE3(), RectificationError(), {}, random)) return std::nullopt;
    last_frame_ = images.frame;
    return T_odom_cam;
  }
  direct_.learn(newest_);
  if (!direct_.become_reference(newest_.T_ref_cur, RectificationError(), {}, random))
    return std::nullopt;
  from_before_ = direct_.confirm(newest_);
  log(log_, LogLevel::kDebug, "surfaces {}: t {:f} agreement {:f} visible {:f} inliers {:f}{}",
      images.frame.id, from_before_->T_ref_cur.translation().norm(), newest_.agreement,
      newest_.visible_share, newest_.inlier_share,
      (from_before_->outcome ? "" : ", " + from_before_->outcome.reason));
  return map.window().pose(map.newest()) * from_before_->T_ref_cur;
}

void DirectTracker::observe(const KeyframeImages& images, const RectificationError& /*error*/,
                            LocalMap& map) {
  if (from_before_)
    add_motion(map.window(), {*map.before_newest(), map.newest(), from_before_->T_ref_cur,
                              from_before_->covariance.ldlt().solve(Matrix6d::Identity())});
  if (!manhattan_) return;
  const auto span = times_.measure("directions");
  manhattan_->observe(map.newest(), images.frame.image, std::nullopt, map.window());
}

std::vector<double> DirectTracker::prune(LocalMap& /*map*/) { return {direct_.median_depth_m()}; }

void DirectTracker::settle(const LocalMap& map) {
  if (manhattan_) manhattan_->settle(map.window());
}

std::vector<PosedFrame> DirectTracker::finish_keyframe(double /*scale*/, const LocalMap& /*map*/) {
  frames_since_keyframe_ = 0;
  return {};
}

FrameView DirectTracker::view(const LocalMap& /*map*/, const SE3& /*T_odom_cam*/) const {
  FrameView view;
  if (manhattan_ && frames_since_keyframe_ == 0) view.directed = manhattan_->view();
  view.surfaces = direct_.view(newest_);
  return view;
}

}  // namespace placegraph
