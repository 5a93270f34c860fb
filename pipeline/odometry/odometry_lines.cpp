#include <placegraph/pipeline/odometry/odometry.h>

namespace placegraph {

void Odometry::observe_lines(std::int64_t keyframe, const Frame& frame) {
  lines_->observe(keyframe, frame, rectification_ ? rectification_->error() : RectificationError(),
                  median_depth_m_, window_);
  if (!cues_.points) lines_->hold_course(keyframe, median_depth_m_, window_);
}

/// Lines are looked for from where the points say, or else from where the camera was going, which
/// is a weak measurement of its own; where it was going is not known at first, so several ways are
/// tried. What points alone tell is the answer where lines tell nothing.
PoseFromLines Odometry::pose_with_lines(const Frame& frame, const SE3& prior,
                                        const Pose3d2dResult& points, Random& random) {
  const LineCue before = *lines_;
  PoseFromLines best;
  const auto look_from = [&](const PoseGuess& guess) {
    LineCue trial = before;
    trial.track(frame.image, window_, guess.T_ref_cam, median_depth_m_);
    const PoseFromLines seen = trial.pose(window_, guess, random);
    if (best.outcome && (!seen.outcome || seen.inliers.size() <= best.inliers.size())) return;
    best = seen;
    *lines_ = std::move(trial);
  };
  if (points.outcome) {
    look_from({points.T_ref_cam, points.information});
  } else {
    constexpr double kSigmaRad = 0.05, kShare = 0.03, kShareAtFirst = 0.08;
    const double sigma_m = velocity_known_
                               ? kShare * median_depth_m_ + 0.5 * T_last_cur_.translation().norm()
                               : kShareAtFirst * median_depth_m_;
    Vector6d sigmas;
    sigmas << Eigen::Vector3d::Constant(sigma_m), Eigen::Vector3d::Constant(kSigmaRad);
    PoseGuess guess{prior, Matrix6d(sigmas.cwiseAbs2().cwiseInverse().asDiagonal())};
    look_from(guess);
    if (!velocity_known_)
      for (const double share : {0.04, 0.08, 0.16, -0.04, -0.08}) {
        guess.T_ref_cam = prior * SE3(SO3(), Eigen::Vector3d(0, 0, share * median_depth_m_));
        look_from(guess);
      }
    // The lines found show where to look for the rest.
    constexpr double kFewFound = 0.7;
    if (best.outcome && lines_->followed(window_) < kFewFound * before.followed(window_)) {
      guess.T_ref_cam = best.T_ref_cam;
      look_from(guess);
    }
  }
  if (!best.outcome && points.outcome) {
    best.outcome = points.outcome;
    best.T_ref_cam = points.T_ref_cam;
  }
  if (best.outcome)
    lines_->accept(window_, best.T_ref_cam);
  else if (cues_.points)
    best.outcome.reason = points.outcome.reason + "; " + best.outcome.reason;
  return best;
}

}  // namespace placegraph
