#pragma once
#include <placegraph/pipeline/odometry/initializer.h>

namespace placegraph {

/// Begins a map with a single frame: a camera that measures depth, or surfaces at a known distance,
/// provide landmarks immediately.
class FirstFrameInitializer : public Initializer {
 public:
  /// `tracker` must outlive it.
  FirstFrameInitializer(FrameTracker& tracker, LogSink log)
      : tracker_(tracker), log_(std::move(log)) {}

  void restart(const SE3& T_odom_cam) override { T_odom_start_ = T_odom_cam; }
  bool started() const override { return false; }  // no view is waiting for a second one
  Initialization add(const Frame& frame, const std::optional<SE3>& T_odom_cam_known, LocalMap& map,
                     LocalMapping& mapping) override;

 private:
  FrameTracker& tracker_;
  LogSink log_;
  SE3 T_odom_start_;
};

}  // namespace placegraph
