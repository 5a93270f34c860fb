#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/measurements/data_note.h>
#include <placegraph/pipeline/health/depth_unit_check.h>
#include <placegraph/pipeline/health/flow_check.h>
#include <placegraph/pipeline/health/image_quality.h>
#include <placegraph/pipeline/health/intrinsics_check.h>
#include <placegraph/pipeline/health/repeated_images.h>
#include <placegraph/pipeline/health/right_image_time.h>
#include <placegraph/pipeline/health/window_residuals.h>
#include <placegraph/pipeline/scale/scale_check.h>

#include <optional>
#include <vector>

namespace placegraph {

class Odometry;
class SlidingWindow;
struct FrameResult;

/// Collects evidence against the images, the calibration and the estimated motion during a run.
/// Each kind of evidence is a class of its own with add() and note().
class HealthMonitor {
 public:
  explicit HealthMonitor(const Calibration& calibration);
  /// Adds a frame after it has been processed.
  void add(const Frame& frame, const FrameResult& result, const Odometry& odometry);
  /// Goes on after a frame that has been added, when the state is that of an earlier run.
  void go_on_after(const Frame& frame) { repeated_.go_on_after(frame); }
  /// What is in doubt so far.
  std::vector<DataNote> notes() const;
  void visit_state(auto& archive) {
    archive(repeated_, images_, right_images_, right_, range_, flow_, scale_, intrinsics_,
            residuals_, newest_);
  }

 private:
  /// Examines a full window, if its keyframes are all newer than those of the last one.
  void examine(const SlidingWindow& window);

  RepeatedImages repeated_;
  ImageQuality images_{"images", NoteCause::kImages};
  ImageQuality right_images_{"right images", NoteCause::kRightImage};
  RightImageTime right_;
  DepthUnitCheck range_;
  FlowCheck flow_;
  ScaleCheck scale_;
  IntrinsicsCheck intrinsics_;
  ResidualCheck residuals_;
  std::optional<KeyframeId> newest_;  // newest keyframe of the last window that was examined
};

}  // namespace placegraph
