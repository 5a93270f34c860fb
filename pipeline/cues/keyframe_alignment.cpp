#include <placegraph/pipeline/cues/keyframe_alignment.h>

#include <Eigen/Cholesky>

namespace placegraph {

KeyframeAlignment::KeyframeAlignment(const DirectCueOptions& options,
                                     const Calibration& calibration,
                                     const StereoMatcherOptions& stereo)
    : cue_(options, calibration, stereo, true),
      measures_depth_(calibration.baseline_m > 0 || calibration.depth) {}

void KeyframeAlignment::reset() {
  cue_.reset();
  forget_newest();
}

void KeyframeAlignment::add(const Keyframe& keyframe, const std::optional<KeyframeId>& previous,
                            const RectificationError& rectification, SlidingWindow& window,
                            Random& random) {
  forget_newest();
  cue_.see(keyframe.frame);
  cue_.restrict_ground(keyframe.ground);
  SE3 T_ref_cur;
  if (previous && cue_.has_reference()) {
    T_ref_cur = window.pose(*previous).inverse() * window.pose(keyframe.id);
    newest_ = cue_.align({T_ref_cur});
    if (newest_.outcome) T_ref_cur = newest_.T_ref_cur;
  }
  cue_.learn(newest_);
  const bool found = cue_.become_reference(T_ref_cur, rectification, keyframe.landmarks, random);
  if (!newest_.outcome) return;
  const DirectMotion motion = found ? cue_.confirm(newest_) : newest_;
  if (!motion.outcome) return;
  Matrix6d covariance = motion.covariance;
  if (!measures_depth_) {
    // The camera's height has already provided the scale of the map: its landmarks carry the same
    // information about the length of the motion, which must not be counted twice.
    const Eigen::Vector3d t =
        motion.T_ref_cur.rotation().inverse() * motion.T_ref_cur.translation();
    covariance.topLeftCorner<3, 3>() += t * t.transpose();
  }
  add_motion(window, {*previous, keyframe.id, motion.T_ref_cur,
                      covariance.ldlt().solve(Matrix6d::Identity())});
}

}  // namespace placegraph
