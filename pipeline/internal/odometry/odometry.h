#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/internal/odometry/initializer.h>

#include <memory>

namespace placegraph {

/// Visual odometry: poses every frame against the landmarks of a sliding window by the cues that
/// the options name, and refines the window at keyframes. Stereo and RGB-D begin with the first
/// frame. A monocular camera waits for a second view with parallax, and takes its scale from the
/// ground where the camera's height is known.
class Odometry {
 public:
  /// `times`, which must outlive it, receives the CPU time of its stages. Throws ArgumentError if
  /// the options or the calibration break their contract, or the cues need a sensor that is not
  /// there.
  Odometry(const OdometryOptions& options, const Calibration& calibration, std::uint64_t seed,
           LogSink log, StageTimes& times);
  Odometry(const Odometry&) = delete;  // its parts refer to each other
  Odometry& operator=(const Odometry&) = delete;

  /// `T_odom_cam_known`, where the frame has been recognized in the map, gives a monocular camera
  /// that begins anew its scale and place.
  [[nodiscard]] OdometryUpdate add_frame(const Frame& frame,
                                         const std::optional<SE3>& T_odom_cam_known = {});
  /// Forgets window and tracks and begins anew with the next frame, which stands at T_odom_cam. If
  /// `in_known_map`, a monocular camera without ground takes its scale from frames that are
  /// recognized; otherwise, if what it sees is about as far away as before, from `median_depth`.
  /// Keyframe ids go on counting.
  void restart(const SE3& T_odom_cam, bool in_known_map = false,
               const std::optional<double>& median_depth = {});
  /// Takes up another run: its next keyframe's id, and how far away things were. To be followed by
  /// restart().
  void go_on_from(KeyframeId next_keyframe, double median_depth) {
    map_.go_on_from(next_keyframe, median_depth);
  }

  /// The camera's motion by other sensors, before the first frame: gives a monocular camera its
  /// scale.
  void set_motion(std::shared_ptr<const MeasuredMotion> motion_cam);
  /// Labels the surfaces of keyframes from now on, before the first frame. `masks`: they say where
  /// points, lines and ground are looked for.
  void set_scene(std::shared_ptr<const SurfaceLabeller> labeller, bool masks);
  /// What holds in the surroundings the camera is in; nothing: all that the options ask for.
  void assume(const std::optional<Assumptions>& assumptions);

  /// The keyframes and landmarks of the present track segment.
  const LocalMap& map() const { return map_; }
  /// Whether a first frame has been taken since the last restart.
  bool started() const { return !map_.empty() || initializer_->started(); }
  /// Tracking goes on in an arbitrary unit that lines on the floor are to replace by the metre:
  /// where a frame is, is not known yet.
  bool awaits_scale() const;
  /// The points of the map that are followed, in the newest frame's camera.
  std::vector<Eigen::Vector3d> points_cam() const;
  /// Edges of the newest image, with their lines in its camera where they are known; not described.
  std::vector<LineFeature> line_features() const;
  /// Over all track segments; a stereo camera's is not estimated.
  const LensEstimator& lens() const { return mapping_.lens(); }
  /// Tracks and ground of the last frame; nothing where it is lost.
  FrameView view() const;

 private:
  OdometryUpdate initialize(const Frame& frame, const std::optional<SE3>& T_odom_cam_known);
  OdometryUpdate track(const Frame& frame);
  bool add_keyframe(const Frame& frame, const SE3& T_odom_cam, OdometryUpdate& update);

  OdometryOptions options_;
  Calibration calibration_;
  std::uint64_t seed_;
  LogSink log_;
  StageTimes& times_;
  LocalMapping mapping_;
  LocalMap map_;
  MotionModel motion_;
  std::unique_ptr<FrameTracker> tracker_;
  std::unique_ptr<Initializer> initializer_;
  bool lost_ = false;  // the last frame has no pose
};

}  // namespace placegraph
