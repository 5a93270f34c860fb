#pragma once
#include <placegraph/frontend/relative_pose/mono_initializer.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/odometry/initializer.h>
#include <placegraph/pipeline/tracking/feature_tracker.h>

namespace placegraph {

/// Begins the map of a monocular camera with two views of points that show parallax. While the
/// camera only rotates, frames are posed by their rotation. When too few points of the first view
/// are still tracked, a newer view replaces it.
class TwoViewInitializer : public Initializer {
 public:
  /// `tracker` and `times` must outlive the initializer.
  TwoViewInitializer(const OdometryOptions& options, const Calibration& calibration,
                     std::uint64_t seed, FeatureTracker& tracker, LogSink log, StageTimes& times);

  void restart(const SE3& T_odom_cam) override;
  bool started() const override { return !views_.empty(); }
  Initialization add(const Frame& frame, const std::optional<SE3>& T_odom_cam_known, LocalMap& map,
                     LocalMapping& mapping) override;

 private:
  struct View {
    FrameId frame;
    std::map<LandmarkId, Eigen::Vector2d> px;  // pixels of its tracks
  };
  Initialization begin(const Frame& frame, LocalMapping& mapping);
  Initialization try_second_view(const Frame& frame, const std::optional<SE3>& T_known,
                                 LocalMap& map, LocalMapping& mapping);
  MonoInitialization motion_to_newest() const;
  std::vector<PartialView> views_between() const;
  std::optional<double> scale_of(const MonoInitialization& start, const std::optional<SE3>& T_known,
                                 const LocalMap& map, const LocalMapping& mapping) const;
  Initialization accept(const Frame& frame, const MonoInitialization& start, double scale,
                        LocalMap& map, LocalMapping& mapping);
  std::vector<PosedFrame> pose_views_between(const LocalMap& map) const;
  Initialization add_pending(const Frame& frame, Outcome outcome);
  Initialization replace_reference(const Frame& frame, const std::optional<SE3>& T_known,
                                   const std::optional<PureRotation>& rotation, LocalMap& map,
                                   LocalMapping& mapping);
  std::string too_few_points() const;
  View view_of(FrameId frame) const;

  OdometryOptions options_;
  Camera camera_;
  std::uint64_t seed_;
  FeatureTracker& tracker_;
  LogSink log_;
  StageTimes& times_;
  // Poses of the first frame after the restart and of the first view.
  SE3 T_odom_restart_, T_odom_start_;
  KeyframeImages reference_;
  std::vector<View> views_;          // the first of them is the reference
  std::vector<PosedFrame> rotated_;  // frames of the initialization, posed by their rotation alone
};

}  // namespace placegraph
