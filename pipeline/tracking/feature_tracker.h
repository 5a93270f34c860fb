#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/cues/keyframe_alignment.h>
#include <placegraph/pipeline/cues/plane_cue.h>
#include <placegraph/pipeline/cues/point_cue.h>
#include <placegraph/pipeline/tracking/camera_velocity.h>
#include <placegraph/pipeline/tracking/cue_list.h>
#include <placegraph/pipeline/tracking/frame_tracker.h>
#include <placegraph/pipeline/tracking/intermediate_frames.h>
#include <placegraph/pipeline/tracking/keyframe_selector.h>
#include <placegraph/pipeline/tracking/odometry_options.h>

namespace placegraph {

/// Tracks points, lines or both. Manhattan frames, planes in depth images and the intensities of
/// surfaces are additional cues where the options select them.
class FeatureTracker : public FrameTracker {
 public:
  /// `times`, which must outlive it, receives the CPU time of its stages.
  FeatureTracker(const OdometryOptions& options, const Calibration& calibration, std::uint64_t seed,
                 LogSink log, StageTimes& times);

  const char* stage() const override { return "frame pose"; }
  void see_first(const Frame& frame) override;
  TrackedFrame track(const Frame& frame, const LocalMap& map, const MotionModel& motion) override;
  std::optional<SE3> prepare_keyframe(const KeyframeImages& images, const SE3& T_odom_cam,
                                      const LocalMap& map) override;
  void observe(const KeyframeImages& images, const RectificationError& rectification,
               LocalMap& map) override;
  std::vector<double> prune(LocalMap& map) override;
  void settle(const LocalMap& map) override;
  std::vector<PosedFrame> finish_keyframe(double scale, const LocalMap& map) override;
  Outcome enough_to_begin(const LocalMap& map) const override;
  void reset() override;
  void drop_masked(const Image& mask, LocalMap& map) override;
  void assume(const std::optional<Assumptions>& assumptions) override;
  bool corrects_rotations() const override { return manhattan_.has_value(); }
  std::optional<Vector6d> velocity() const override {
    return velocity_.known() ? std::optional(velocity_.at()) : std::nullopt;
  }
  void correct(const RgbdErrors& errors) override { points_.correct(errors); }
  LineCue* lines() override { return lines_ ? &*lines_ : nullptr; }
  const ManhattanCue* manhattan() const override;
  std::vector<Eigen::Vector3d> points_odom(const LocalMap& map) const override;
  FrameView view(const LocalMap& map, const SE3& T_odom_cam) const override;

  PointCue& points() { return points_; }
  /// Adds the directions of the newest keyframe's edges to the window, if Manhattan frames are
  /// among the cues and accepted.
  void observe_directions(const Image& image, LocalMap& map);
  /// Rotation of the camera since its tracks were at `px_before`, with the newest `frame`; nothing
  /// if the tracks show a translation, or if the camera measures depth.
  std::optional<PureRotation> rotation_since(const std::map<LandmarkId, Eigen::Vector2d>& px_before,
                                             FrameId frame) const;
  /// Makes the newest keyframe the reference for the selection of the next ones.
  void start_selection(int landmarks);

 private:
  PointCue::TrackedPose pose_by_points(const Frame& frame, const LocalMap& map,
                                       const MotionModel& motion);
  void remember_motion(const Frame& frame, const SE3& T_odom_last, const SE3& T_odom_cam);
  bool monocular_points() const;
  bool contradicted(FrameId frame, const SE3& T_previous_this) const;
  std::optional<ManhattanCue::RotationEstimate> rotation_from_manhattan(const Frame& frame,
                                                                        const SE3& T_odom_cam,
                                                                        int inliers,
                                                                        const LocalMap& map) const;
  bool keyframe_due(const SE3& T_odom_cam, int inliers, const LocalMap& map) const;
  void observe_planes(const Frame& frame, LocalMap& map);

  OdometryOptions options_;
  Calibration calibration_;
  Cues cues_;
  std::uint64_t seed_;
  LogSink log_;
  StageTimes& times_;
  PointCue points_;
  std::optional<LineCue> lines_;
  std::optional<ManhattanCue> manhattan_;
  bool manhattan_trusted_ = true;  // whether Manhattan frames are assumed to exist
  std::optional<PlaneCue> planes_;
  std::optional<KeyframeAlignment> direct_;
  KeyframeSelector selector_;
  IntermediateFrames intermediate_;
  CameraVelocity velocity_;
  std::optional<std::int64_t> stamp_ns_;  // the last posed frame's
};

}  // namespace placegraph
