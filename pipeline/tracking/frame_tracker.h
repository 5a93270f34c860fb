#pragma once
#include <placegraph/frontend/features/rgbd_errors.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/scene/environment.h>
#include <placegraph/pipeline/cues/frame_view.h>
#include <placegraph/pipeline/local_map/keyframe_masks.h>
#include <placegraph/pipeline/local_map/metric_scale.h>
#include <placegraph/pipeline/tracking/motion_model.h>
#include <placegraph/pipeline/tracking/odometry_update.h>

namespace placegraph {

/// Pose of one frame against the local map.
struct TrackedFrame {
  Outcome outcome;
  SE3 T_odom_cam;  ///< only valid if `outcome` is a success
  int inliers = 0;
  double agreement = 1;  ///< share of the tracked landmarks that agree with the pose
  bool keyframe_due = false;
  /// Whether the images contradict its rotation since the previous frame (contradicts_rotation).
  bool contradicted = false;
  std::optional<PureRotation> rotation;  ///< rotation that explains a failure
};

/// Poses frames with its cues, and adds the observations of keyframes to the window. New cues are
/// added here; the odometry is independent of them.
class FrameTracker {
 public:
  virtual ~FrameTracker() = default;

  /// Name of the stage to which its CPU time is added.
  virtual const char* stage() const = 0;
  /// Processes the first image, before a map exists.
  virtual void see_first(const Frame& frame) = 0;
  /// Poses a frame near the pose predicted by `motion`. After a failure, the tracks are in the
  /// state before the call.
  [[nodiscard]] virtual TrackedFrame track(const Frame& frame, const LocalMap& map,
                                           const MotionModel& motion) = 0;
  /// After a failure: the last posed frame, if it may help as a keyframe.
  virtual std::optional<Frame> keyframe_to_retry_from() const { return std::nullopt; }

  /// Prepares a frame with pose T_odom_cam to become a keyframe. Returns its refined pose; nothing
  /// if the frame lacks the observations for a keyframe.
  [[nodiscard]] virtual std::optional<SE3> prepare_keyframe(const KeyframeImages& images,
                                                            const SE3& T_odom_cam,
                                                            const LocalMap& map) = 0;
  /// Adds its observations in the newest keyframe of the map to the window.
  virtual void observe(const KeyframeImages& images, const RectificationError& rectification,
                       LocalMap& map) = 0;
  /// Removes outliers after the window has been optimized. Returns depths of the remaining
  /// landmarks in the newest keyframe.
  [[nodiscard]] virtual std::vector<double> prune(LocalMap& map) = 0;
  /// Updates its state after keyframes have left the window.
  virtual void settle(const LocalMap& map) = 0;
  /// Completes the newest keyframe: poses the frames since the previous keyframe again. `scale`:
  /// factor applied to lengths with this keyframe.
  [[nodiscard]] virtual std::vector<PosedFrame> finish_keyframe(double scale,
                                                                const LocalMap& map) = 0;
  /// Whether the first keyframe shows enough landmarks for tracking; otherwise the reason.
  virtual Outcome enough_to_begin(const LocalMap& /*map*/) const { return Outcome::ok(); }
  virtual void reset() = 0;
  /// Drops the tracks whose pixel is 0 in `mask` (CV_8UC1), and their landmarks.
  virtual void drop_masked(const Image& /*mask*/, LocalMap& /*map*/) {}

  /// Sets the assumptions about the environment; nothing: all cues of the options are used.
  virtual void assume(const std::optional<Assumptions>& /*assumptions*/) {}
  /// Whether rotations are constrained by more than the keyframes of the window.
  virtual bool corrects_rotations() const = 0;
  /// Velocity of the camera at the newest frame [m/s, rad/s], right tangent; nothing: not known.
  virtual std::optional<Vector6d> velocity() const { return std::nullopt; }
  /// Sets the errors that its observations are corrected by from now on.
  virtual void correct(const RgbdErrors& /*errors*/) {}
  /// Tracked lines; null if lines are not among the cues.
  virtual LineCue* lines() { return nullptr; }
  /// Manhattan frames observed in the newest keyframe; null where they are not accepted.
  virtual const ManhattanCue* manhattan() const { return nullptr; }
  /// Tracked points of the map, in the odometry frame.
  virtual std::vector<Eigen::Vector3d> points_odom(const LocalMap& /*map*/) const { return {}; }
  /// Features of the newest frame, with pose T_odom_cam.
  virtual FrameView view(const LocalMap& map, const SE3& T_odom_cam) const = 0;
};

}  // namespace placegraph
