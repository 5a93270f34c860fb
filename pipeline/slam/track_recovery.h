#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/measurements/measured_motion.h>
#include <placegraph/pipeline/loops/loop_closer.h>
#include <placegraph/pipeline/odometry/odometry.h>
#include <placegraph/pipeline/places/place_mapper.h>
#include <placegraph/pipeline/slam/trajectory_recorder.h>

#include <memory>
#include <optional>

namespace placegraph {

struct TrackRecoveryOptions {
  int max_lost_frames = 10;  ///< consecutive lost frames before a new component of the map begins
  /// A translation that moves points by less is treated as a rotation.
  double rotation_rad = 1.5 / 700;
};

/// State of the map at the time of a tracking loss.
struct KnownMap {
  const LoopCloser& closer;
  const PlaceMapper& mapper;
  const TrajectoryRecorder& recorder;
  /// Pose in the map of a frame that is located relative to a keyframe.
  SE3 T_map_frame(const LocatedFrame& located) const;
};

/// Location of a camera that has turned on the spot since it was at `before`. `covariance_before`:
/// of that pose, in its right tangent; `sigma_m`: how far it may have moved, in the map's unit.
LocatedFrame turned(const LocatedFrame& before, const Matrix6d& covariance_before,
                    const PureRotation& rotation, double sigma_m);

/// Connects track segments to the map. After a loss, a frame is located by recognizing a keyframe,
/// by a pure rotation since the last one, or by the motion measured by other sensors; the next
/// segment begins there. If no method locates a frame for long, a new component of the map begins.
///
/// The anchor connects the next segment to the map. It is set when a frame is located and consumed
/// by the first keyframe of the segment.
class TrackRecovery {
 public:
  TrackRecovery(const TrackRecoveryOptions& options, LogSink log)
      : options_(options), log_(std::move(log)) {}
  /// Sets the motion of the camera measured by other sensors.
  void use_motion(std::shared_ptr<const MeasuredMotion> motion_cam);

  /// Lets the odometry process a frame. While no segment is connected to the map, the frame is
  /// located first. If it has no pose and can be located, or if too many frames were lost, tracking
  /// restarts with it; the odometry has then processed it again.
  OdometryUpdate handle(const Frame& frame, const KnownMap& known, Odometry& odometry);
  /// Begins a new component of the map with the next frame.
  void begin_component(FrameId frame, Odometry& odometry);
  /// The same where the newest keyframes are wrong: until the component has begun, frames are not
  /// located at keyframes, for as long as a loss may last.
  void begin_apart(FrameId frame, Odometry& odometry);
  /// Location of the frame of handle(), which is not tracked; nothing if it is unknown. Follows
  /// PlaceMapper::add_keyframe() of the keyframes in `update`.
  std::optional<LocatedFrame> pose_without_tracking(const Frame& frame,
                                                    const OdometryUpdate& update,
                                                    const KnownMap& known,
                                                    const Odometry& odometry);
  /// Sets the pose in the map of the newest frame that has one.
  void stands_at(const SE3& T_map_frame) { T_map_last_ = T_map_frame; }
  void rescale(double factor) { T_map_last_ = T_map_last_.scaled(factor); }

  /// Connects the next segment to keyframe `newest`, which its first frame shows again: its pose is
  /// known except for rounding. The segment then continues that of the keyframe.
  void take_up(KeyframeId newest, double median_depth, const KnownMap& known);
  /// Link of the first keyframe of a segment to the map; nothing if it begins a component. Consumes
  /// the anchor.
  std::optional<PlaceMapper::Link> take_link(const LocalMap& map, const PlaceMapper& mapper);
  const SE3& T_map_last() const { return T_map_last_; }
  /// Motion measured by other sensors; null if there is none.
  const MeasuredMotion* motion() const { return motion_.get(); }

 private:
  std::optional<LocatedFrame> locate_before(const Frame& frame, const KnownMap& known,
                                            Odometry& odometry);
  std::optional<LocatedFrame> locate_after(const std::optional<LocatedFrame>& before,
                                           const OdometryUpdate& update, const KnownMap& known,
                                           const Odometry& odometry);
  bool must_restart(const OdometryUpdate& update, const KnownMap& known) const;
  OdometryUpdate restart(const Frame& frame, const OdometryUpdate& update, const KnownMap& known,
                         Odometry& odometry);
  std::optional<LocatedFrame> by_motion(const Frame& frame, const KnownMap& known) const;
  std::optional<LocatedFrame> by_rotation(const OdometryUpdate& update, const KnownMap& known,
                                          double median_depth) const;

  TrackRecoveryOptions options_;
  LogSink log_;
  std::shared_ptr<const MeasuredMotion> motion_;
  std::optional<LocatedFrame> located_;  // the newest frame, without its landmarks
  std::optional<LocatedFrame> anchor_;
  bool continues_ = false;  // the anchor's keyframe is in the same segment
  SE3 T_map_last_;
  int lost_in_a_row_ = 0;
  int apart_ = 0;  // number of frames that are still not located at keyframes
};

}  // namespace placegraph
