#pragma once
#include <placegraph/graph/internal/core/random.h>
#include <placegraph/pipeline/cues/frame_view.h>
#include <placegraph/pipeline/internal/local_map/keyframe_masks.h>
#include <placegraph/pipeline/internal/local_map/metric_scale.h>
#include <placegraph/pipeline/internal/tracking/motion_model.h>
#include <placegraph/pipeline/internal/tracking/odometry_update.h>

namespace placegraph {

/// One frame posed against the local map.
struct TrackedFrame {
  Outcome outcome;
  SE3 T_odom_cam;  ///< meaningful only if outcome
  int inliers = 0;
  bool keyframe_due = false;
  std::optional<PureRotation> rotation;  ///< of a failure: what explains it
};

/// Poses frames by the cues that it follows, and hands what keyframes observe of them to the
/// window. A cue is added here; the odometry does not know it.
class FrameTracker {
 public:
  virtual ~FrameTracker() = default;

  /// The name of the stage that its CPU time counts for.
  virtual const char* stage() const = 0;
  /// Takes in the first image, before there is a map.
  virtual void see_first(const Frame& frame) = 0;
  /// Poses a frame; `motion` says where it is expected. If that fails, what is followed is as it
  /// was before the call.
  [[nodiscard]] virtual TrackedFrame track(const Frame& frame, const LocalMap& map,
                                           const MotionModel& motion, Random& random) = 0;
  /// After a failure: the last frame that was posed, if it may help as a keyframe.
  virtual std::optional<Frame> keyframe_to_retry_from() const { return std::nullopt; }

  /// A frame, posed at T_odom_cam, is about to become a keyframe. Returns where it stands as such;
  /// nothing if it shows nothing to be a keyframe by.
  [[nodiscard]] virtual std::optional<SE3> prepare_keyframe(const KeyframeImages& images,
                                                            const SE3& T_odom_cam,
                                                            const LocalMap& map,
                                                            Random& random) = 0;
  /// Hands what it observes to the window; it is the newest keyframe of the map.
  virtual void observe(const KeyframeImages& images, const RectificationError& rectification,
                       LocalMap& map, Random& random) = 0;
  /// After the window has been optimized: removes what does not fit. Returns depths in the newest
  /// keyframe of what stays.
  [[nodiscard]] virtual std::vector<double> prune(LocalMap& map) = 0;
  /// After keyframes have left the window.
  virtual void settle(const LocalMap& map) = 0;
  /// The newest keyframe is complete: poses the frames since the keyframe before it once more.
  /// `scale`: what lengths have grown by with it.
  [[nodiscard]] virtual std::vector<PosedFrame> finish_keyframe(double scale,
                                                                const LocalMap& map) = 0;
  /// Whether the first keyframe shows enough landmarks to track by; else what is missing.
  virtual Outcome enough_to_begin(const LocalMap& /*map*/) const { return Outcome::ok(); }
  virtual void reset() = 0;

  /// What holds in the surroundings; nothing: all that the options ask for.
  virtual void assume(const std::optional<Assumptions>& /*assumptions*/) {}
  /// Whether anything but keyframes of the window holds rotations.
  virtual bool corrects_rotations() const = 0;
  /// The lines that are followed; null if they are not among the cues.
  virtual LineCue* lines() { return nullptr; }
  /// Manhattan frames, as the newest keyframe sees them; null where they are not believed.
  virtual const ManhattanCue* manhattan() const { return nullptr; }
  /// The points of the map that are followed, in the odometry frame.
  virtual std::vector<Eigen::Vector3d> points_odom(const LocalMap& /*map*/) const { return {}; }
  /// What the newest frame shows, posed at T_odom_cam.
  virtual FrameView view(const LocalMap& map, const SE3& T_odom_cam) const = 0;
};

}  // namespace placegraph
