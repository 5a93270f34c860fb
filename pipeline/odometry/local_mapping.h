#pragma once
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/graph/scene/environment.h>
#include <placegraph/pipeline/local_map/lens_estimator.h>
#include <placegraph/pipeline/local_map/rgbd_calibrator.h>
#include <placegraph/pipeline/local_map/stereo_rectifier.h>
#include <placegraph/pipeline/tracking/frame_tracker.h>
#include <placegraph/pipeline/tracking/odometry_options.h>

namespace placegraph {

/// Adds frames as keyframes to the local map and keeps the map optimized: measures its scale,
/// calibrates the cameras, and marginalizes keyframes that leave the window.
class LocalMapping {
 public:
  /// `times`, which must outlive the object, receives the CPU time of its stages.
  LocalMapping(const OdometryOptions& options, const Calibration& calibration, LogSink log,
               StageTimes& times);

  struct Added {
    NewKeyframe keyframe;
    std::vector<PosedFrame> posed_again;  ///< frames since the keyframe before it
    std::optional<Rescale> rescale;       ///< set when the scale became known
  };
  /// Makes a frame with pose T_odom_cam a keyframe; nothing if the frame lacks the observations for
  /// a keyframe.
  std::optional<Added> add(const Frame& frame, const SE3& T_odom_cam, FrameTracker& tracker,
                           LocalMap& map);
  /// Optimizes the window, removes outliers, and reduces the window to its size.
  void refine(FrameTracker& tracker, LocalMap& map);
  /// Measures the scale at the newest keyframe, if a measurement is available. Returns the change
  /// of lengths.
  std::optional<Rescale> measure_scale(const KeyframeImages& images, FrameTracker& tracker,
                                       LocalMap& map);

  KeyframeMasks& masks() { return masks_; }
  MetricScale& scale() { return scale_; }
  const MetricScale& scale() const { return scale_; }
  const LensEstimator& lens() const { return lens_; }
  /// What is learned of the cameras. Once read, `tracker` corrects its observations by it.
  void visit_state(auto& archive, FrameTracker& tracker) {
    archive(lens_);
    if (rectifier_) archive(*rectifier_);
    if (!rgbd_) return;
    archive(*rgbd_);
    if (archive.kReads) tracker.correct(rgbd_->errors());
  }
  /// Changes of motions by what has been learned about the errors of an RGB-D camera since they
  /// left the window, see RgbdCalibrator::corrections().
  std::map<KeyframeId, Vector6d> corrections() const;
  /// Sets the assumptions about the environment; nothing: all cues of the options are used.
  void assume(const std::optional<Assumptions>& assumptions);

 private:
  RectificationError rectification() const;
  void calibrate(FrameTracker& tracker, LocalMap& map);
  void use_errors(const RgbdCalibrator& rgbd, FrameTracker& tracker, LocalMap& map);

  LogSink log_;
  StageTimes& times_;
  KeyframeMasks masks_;
  MetricScale scale_;
  std::optional<StereoRectifier> rectifier_;  // only for a stereo camera
  std::optional<RgbdCalibrator> rgbd_;        // only for an RGB-D camera
  // Number of keyframes of a window that reveals lens distortion.
  std::optional<std::size_t> lens_window_;
  LensEstimator lens_;
};

}  // namespace placegraph
