#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/measurements/measured_motion.h>
#include <placegraph/pipeline/internal/loops/loop_closer.h>
#include <placegraph/pipeline/internal/odometry/odometry.h>
#include <placegraph/pipeline/internal/places/place_mapper.h>
#include <placegraph/pipeline/internal/slam/trajectory_recorder.h>

#include <memory>
#include <optional>

namespace placegraph {

struct TrackRecoveryOptions {
  int max_lost_frames = 10;         ///< then a new component of the map begins
  double rotation_rad = 1.5 / 700;  ///< translation that moves points by less passes for a rotation
};

/// What is known of the map where tracking breaks off.
struct KnownMap {
  const LoopCloser& closer;
  const PlaceMapper& mapper;
  const TrajectoryRecorder& recorder;
  /// The pose in the map of a frame that is located relative to a keyframe.
  SE3 T_map_frame(const LocatedFrame& located) const;
};

/// Joins track segments to the map. After a loss a frame is located by recognizing a keyframe, by a
/// pure rotation since the last one, or by the motion that other sensors measured; the next segment
/// begins there. Where nothing locates it for long, a new component of the map begins.
///
/// The anchor is how the next segment hangs on the map. It stands from when a frame is located
/// until the first keyframe of the segment takes it.
class TrackRecovery {
 public:
  TrackRecovery(const TrackRecoveryOptions& options, LogSink log)
      : options_(options), log_(std::move(log)) {}
  /// The camera's motion by other sensors.
  void use_motion(std::shared_ptr<const MeasuredMotion> motion_cam);

  /// Where a frame is that the odometry has not seen yet; only while no segment hangs on the map.
  std::optional<LocatedFrame> expect(const Frame& frame, const KnownMap& known, Odometry& odometry);
  /// The same after the odometry has seen it, which may know that the camera has only rotated.
  /// `expected`: from expect().
  std::optional<LocatedFrame> locate(const std::optional<LocatedFrame>& expected,
                                     const OdometryUpdate& update, const KnownMap& known,
                                     const Odometry& odometry);
  /// Whether the frame has no pose and tracking must begin anew.
  bool needed(const OdometryUpdate& update, const KnownMap& known) const;
  /// Begins anew where the frame can be located (`located`: if it is already); the odometry has
  /// then seen it again. Otherwise the update stays as it is.
  OdometryUpdate restart(const Frame& frame, std::optional<LocatedFrame> located,
                         const OdometryUpdate& update, const KnownMap& known, Odometry& odometry);
  /// Where a frame stands that is not tracked; nothing if that is not known.
  std::optional<LocatedFrame> pose_without_tracking(const Frame& frame,
                                                    const std::optional<LocatedFrame>& located,
                                                    const OdometryUpdate& update,
                                                    const KnownMap& known,
                                                    const Odometry& odometry);
  /// The newest frame is tracked.
  void tracked() { lost_in_a_row_ = 0; }
  /// The newest frame that has a pose stands here, in the map.
  void stands_at(const SE3& T_map_frame) { T_map_last_ = T_map_frame; }
  void rescale(double factor) { T_map_last_ = T_map_last_.scaled(factor); }

  /// Hangs the next segment on keyframe `newest`, which its first frame shows again: its pose is
  /// known but for rounding. The segment is then the continuation of the keyframe's own.
  void take_up(KeyframeId newest, double median_depth, const KnownMap& known);
  /// The link of the first keyframe of a segment to the map; nothing if it begins a component. The
  /// anchor is used up.
  std::optional<PlaceMapper::Link> take_link(const LocalMap& map, const PlaceMapper& mapper);
  const SE3& T_map_last() const { return T_map_last_; }
  /// Motion by other sensors; null if there is none.
  const MeasuredMotion* motion() const { return motion_.get(); }

 private:
  std::optional<LocatedFrame> by_motion(const Frame& frame, const KnownMap& known) const;
  std::optional<LocatedFrame> by_rotation(const OdometryUpdate& update, const KnownMap& known,
                                          double median_depth) const;

  TrackRecoveryOptions options_;
  LogSink log_;
  std::shared_ptr<const MeasuredMotion> motion_;
  std::optional<LocatedFrame> anchor_;
  bool continues_ = false;  // the anchor's keyframe is of the same segment
  SE3 T_map_last_;
  int lost_in_a_row_ = 0;
};

}  // namespace placegraph
