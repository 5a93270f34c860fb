#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/scene/environment.h>
#include <placegraph/pipeline/odometry/initializer.h>

#include <memory>

namespace placegraph {

/// Visual odometry: poses every frame against the landmarks of a sliding window with the cues
/// selected by the options, and optimizes the window at keyframes. Stereo and RGB-D start with the
/// first frame. A monocular camera waits for a second view with parallax, and takes its scale from
/// the ground if the camera's height is known.
class Odometry {
 public:
  /// `times`, which must outlive the object, receives the CPU time of its stages. Throws
  /// ArgumentError if the options or the calibration are invalid, or if the cues need a sensor that
  /// is missing.
  Odometry(const OdometryOptions& options, const Calibration& calibration, std::uint64_t seed,
           LogSink log, StageTimes& times);
  Odometry(const Odometry&) = delete;  // its members refer to each other
  Odometry& operator=(const Odometry&) = delete;

  /// Processes a frame. `T_odom_cam_known`, set if the frame has been recognized in the map,
  /// provides pose and scale when a monocular camera restarts.
  [[nodiscard]] OdometryUpdate add_frame(const Frame& frame,
                                         const std::optional<SE3>& T_odom_cam_known = {});
  /// Drops window and tracks and restarts with the next frame, whose pose is T_odom_cam. If
  /// `in_known_map`, a monocular camera without ground takes its scale from recognized frames;
  /// otherwise from `median_depth`, if the depth of the scene is about the same as before. Keyframe
  /// ids continue.
  void restart(const SE3& T_odom_cam, bool in_known_map = false,
               const std::optional<double>& median_depth = {});
  /// Continues another run: sets the id of the next keyframe and the median depth. Must be followed
  /// by restart().
  void go_on_from(KeyframeId next_keyframe, double median_depth) {
    map_.go_on_from(next_keyframe, median_depth);
  }

  /// Drops the tracks and landmarks whose pixel in the newest image is 0 in `mask` (CV_8UC1).
  void drop_masked(const Image& mask) { tracker_->drop_masked(mask, map_); }

  /// Sets the motion of the camera measured by other sensors, before the first frame: it provides
  /// the scale of a monocular camera.
  void set_motion(std::shared_ptr<const MeasuredMotion> motion_cam);
  /// Labels the surfaces of keyframes, starting with the first frame. `masks`: use the labels as
  /// masks for points, lines and ground.
  void set_scene(std::shared_ptr<const SurfaceLabeller> labeller, bool masks);
  /// Sets the assumptions about the environment; nothing: all cues of the options are used.
  void assume(const std::optional<Assumptions>& assumptions);

  /// Keyframes and landmarks of the current track segment.
  const LocalMap& map() const { return map_; }
  /// The newest comparison of the map's scale with the ground.
  const std::optional<ScaleComparison>& scale_compared() const {
    return mapping_.scale().compared();
  }
  /// Whether a first frame has been taken since the last restart.
  bool started() const { return !map_.empty() || initializer_->started(); }
  /// Whether tracking uses an arbitrary scale that lines on the floor will replace by the metric
  /// one; poses are not reported until then.
  bool awaits_scale() const;
  /// Tracked points of the map, in the newest frame's camera.
  std::vector<Eigen::Vector3d> points_cam() const;
  /// Edges of the newest image, with their lines in its camera where these are known; without
  /// descriptors.
  std::vector<LineFeature> line_features() const;
  /// Lens distortion over all track segments; not estimated for a stereo camera.
  const LensEstimator& lens() const { return mapping_.lens(); }
  /// What is learned of the camera and of the motion over all track segments.
  void visit_state(auto& archive) {
    archive(map_);
    mapping_.visit_state(archive, *tracker_);
  }
  /// See RgbdCalibrator::corrections().
  std::map<KeyframeId, Vector6d> corrections() const { return mapping_.corrections(); }
  /// Tracks and ground of the last frame; nothing if it is lost.
  FrameView view() const;

 private:
  OdometryUpdate initialize(const Frame& frame, const std::optional<SE3>& T_odom_cam_known);
  OdometryUpdate track(const Frame& frame);
  bool add_keyframe(const Frame& frame, const SE3& T_odom_cam, OdometryUpdate& update);

  OdometryOptions options_;
  Calibration calibration_;
  LogSink log_;
  StageTimes& times_;
  LocalMapping mapping_;
  LocalMap map_;
  MotionModel motion_;
  std::unique_ptr<FrameTracker> tracker_;
  std::unique_ptr<Initializer> initializer_;
  bool lost_ = false;  // whether the last frame has no pose
};

}  // namespace placegraph
