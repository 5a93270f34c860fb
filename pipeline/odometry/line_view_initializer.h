#pragma once
#include <placegraph/pipeline/odometry/initializer.h>
#include <placegraph/pipeline/tracking/feature_tracker.h>

namespace placegraph {

/// Begins the map of a monocular camera that tracks lines without points, with several views,
/// because two views of lines do not constrain the motion between them. When too few lines of the
/// first view are still tracked, a newer view replaces it.
class LineViewInitializer : public Initializer {
 public:
  /// `tracker` must outlive the initializer and track lines.
  LineViewInitializer(const OdometryOptions& options, const Calibration& calibration,
                      std::uint64_t seed, FeatureTracker& tracker, LogSink log);

  void restart(const SE3& T_odom_cam) override;
  bool started() const override { return !views_.empty(); }
  Initialization add(const Frame& frame, const std::optional<SE3>& T_odom_cam_known, LocalMap& map,
                     LocalMapping& mapping) override;

 private:
  struct View {
    Frame frame;
    LineView lines;
  };
  Initialization begin(const Frame& frame);
  bool enough_in_common() const;
  LineInitialization motion_of_views() const;
  std::vector<double> depths_of(const LineInitialization& start) const;
  std::optional<double> scale_of(double median_depth, const std::optional<SE3>& T_known,
                                 const LocalMap& map, const LocalMapping& mapping) const;
  bool add_keyframes(const std::vector<std::size_t>& chosen, const LineInitialization& start,
                     double scale, double median_depth, LocalMap& map, LocalMapping& mapping);
  bool motion_is_known(const std::vector<std::size_t>& chosen, const LineInitialization& start,
                       const LocalMap& map) const;
  Initialization accept(const std::vector<std::size_t>& chosen, const LineInitialization& start,
                        LocalMap& map, LocalMapping& mapping);
  std::vector<PosedFrame> views_between(const std::vector<std::size_t>& chosen,
                                        const LineInitialization& start, const LocalMap& map) const;
  Initialization replace_reference(const Frame& frame, const std::optional<SE3>& T_known,
                                   const LocalMap& map);

  LineInitializerOptions options_;
  Camera camera_;
  std::uint64_t seed_;
  FeatureTracker& tracker_;
  LogSink log_;
  // Poses of the first frame after the restart and of the first view.
  SE3 T_odom_restart_, T_odom_start_;
  std::vector<View> views_;
};

}  // namespace placegraph
