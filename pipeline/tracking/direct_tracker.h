#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/cues/direct_cue.h>
#include <placegraph/pipeline/tracking/frame_tracker.h>
#include <placegraph/pipeline/tracking/odometry_options.h>

namespace placegraph {

/// Aligns frames with the intensities of the surfaces of the last keyframe (Siddiqui 2015, section
/// IV, 3.4), without features. When a small part of the surfaces remains visible, the frame becomes
/// the next keyframe, in which surfaces are detected again. When alignment fails, the last posed
/// frame replaces the keyframe, with surfaces closer to the current view.
class DirectTracker : public FrameTracker {
 public:
  /// `times`, which must outlive it, receives the CPU time of its stages.
  DirectTracker(const OdometryOptions& options, const Calibration& calibration, std::uint64_t seed,
                LogSink log, StageTimes& times);

  const char* stage() const override { return "surfaces"; }
  void see_first(const Frame& frame) override { see(frame); }
  TrackedFrame track(const Frame& frame, const LocalMap& map, const MotionModel& motion) override;
  std::optional<Frame> keyframe_to_retry_from() const override;
  std::optional<SE3> prepare_keyframe(const KeyframeImages& images, const SE3& T_odom_cam,
                                      const LocalMap& map) override;
  void observe(const KeyframeImages& images, const RectificationError& rectification,
               LocalMap& map) override;
  std::vector<double> prune(LocalMap& map) override;
  void settle(const LocalMap& map) override;
  std::vector<PosedFrame> finish_keyframe(double scale, const LocalMap& map) override;
  void reset() override;
  bool corrects_rotations() const override { return manhattan_.has_value(); }
  FrameView view(const LocalMap& map, const SE3& T_odom_cam) const override;

 private:
  void see(const Frame& frame);
  DirectMotion align(const LocalMap& map, const MotionModel& motion) const;
  bool keyframe_due(const DirectMotion& motion, double median_depth) const;

  DirectCueOptions options_;
  int max_interval_;  // frames between keyframes
  std::uint64_t seed_;
  LogSink log_;
  StageTimes& times_;
  DirectCue direct_;
  std::optional<FrameId> seen_;  // last frame in which the surfaces were observed
  std::optional<ManhattanCue> manhattan_;
  DirectMotion newest_;  // motion of the last posed frame from the last keyframe
  std::optional<DirectMotion> from_before_;  // motion of the frame that becomes a keyframe
  Frame last_frame_;                         // last posed frame
  int frames_since_keyframe_ = 0;
};

}  // namespace placegraph
