#pragma once
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/pipeline/internal/local_map/lens_estimator.h>
#include <placegraph/pipeline/internal/local_map/stereo_rectifier.h>
#include <placegraph/pipeline/internal/tracking/frame_tracker.h>
#include <placegraph/pipeline/tracking/odometry_options.h>

namespace placegraph {

/// Turns frames into keyframes of the local map and keeps the map at its optimum: measures its
/// scale, calibrates the cameras, and marginalizes what leaves the window.
class LocalMapping {
 public:
  /// `times`, which must outlive it, receives the CPU time of its stages.
  LocalMapping(const OdometryOptions& options, const Calibration& calibration, std::uint64_t seed,
               LogSink log, StageTimes& times);

  struct Added {
    NewKeyframe keyframe;
    std::vector<PosedFrame> posed_again;  ///< frames since the keyframe before it
    std::optional<Rescale> rescale;       ///< the scale became known
  };
  /// Makes a frame that is posed at T_odom_cam a keyframe; nothing if it shows nothing to be one
  /// by.
  std::optional<Added> add(const Frame& frame, const SE3& T_odom_cam, FrameTracker& tracker,
                           LocalMap& map);
  /// Optimizes the window, removes what does not fit, and reduces the window to its size.
  void refine(FrameTracker& tracker, LocalMap& map);
  /// Measures the scale at the newest keyframe, if anything measures it. Returns how lengths have
  /// grown.
  std::optional<Rescale> measure_scale(const KeyframeImages& images, FrameTracker& tracker,
                                       LocalMap& map);

  KeyframeMasks& masks() { return masks_; }
  MetricScale& scale() { return scale_; }
  const MetricScale& scale() const { return scale_; }
  const LensEstimator& lens() const { return lens_; }
  /// What holds in the surroundings; nothing: all that the options ask for.
  void assume(const std::optional<Assumptions>& assumptions);

 private:
  RectificationError rectification() const;
  void calibrate(FrameTracker& tracker, LocalMap& map);

  std::uint64_t seed_;
  LogSink log_;
  StageTimes& times_;
  KeyframeMasks masks_;
  MetricScale scale_;
  std::optional<StereoRectifier> rectifier_;  // of a stereo camera
  std::optional<std::size_t> lens_window_;    // keyframes of a window that shows lens distortion
  LensEstimator lens_;
};

}  // namespace placegraph
