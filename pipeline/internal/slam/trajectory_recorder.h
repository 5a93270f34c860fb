#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/internal/tracking/odometry_update.h>

#include <map>
#include <optional>
#include <vector>

namespace placegraph {

/// Records every frame: relative to a keyframe, to be corrected while that is refined, and online,
/// as it was known when the frame was done.
class TrajectoryRecorder {
 public:
  /// The next frame, without a pose. Ids and stamps must increase (see accepts()).
  void begin(const Frame& frame);
  bool accepts(const Frame& frame) const;
  /// The newest frame stands at T_keyframe_frame of a keyframe.
  void record(KeyframeId keyframe, const SE3& T_keyframe_frame, int inliers);
  /// The newest frame is done: its pose in the first component of the map, if it has one.
  void finish(const std::optional<SE3>& T_map_cam);

  /// A frame has become a keyframe.
  void add_keyframe(const NewKeyframe& keyframe);
  /// Frames have better poses in the odometry frame of a track segment, whose keyframes stand in
  /// `map`. Those from before it hang on keyframe `first_new` from now on.
  void correct(const std::vector<PosedFrame>& posed, KeyframeId first_new, const LocalMap& map);
  /// All lengths relative to keyframes from `first_keyframe` on grow by `factor`.
  void rescale(KeyframeId first_keyframe, double factor);

  /// While a monocular camera waits for its second view, the first one is the origin of the map.
  /// The newest frame is that; `rotated`: and it has only rotated since the one before it, which
  /// stays. Otherwise earlier ones have no pose after all.
  void begin_at_origin(bool rotated);

  bool empty() const { return records_.empty(); }
  /// Nothing before the first keyframe.
  std::optional<KeyframeId> newest_keyframe() const {
    return frames_.empty() ? std::nullopt : std::optional(frames_.rbegin()->first);
  }
  const FrameRecord& newest() const { return records_.back(); }
  bool newest_has_keyframe() const { return records_.back().keyframe.has_value(); }
  const std::vector<FrameRecord>& records() const { return records_; }
  const Trajectory& online() const { return online_; }
  FrameId frame_of(KeyframeId keyframe) const { return frames_.at(keyframe); }
  std::int64_t stamp_ns_of(KeyframeId keyframe) const { return stamps_ns_.at(keyframe); }

  /// Records from this one on have changed since they were told last.
  std::size_t first_changed() const { return first_changed_; }
  void tell_all() { first_changed_ = records_.size(); }
  /// Takes over the frames of a saved map up to `last_frame`.
  void take_up(const Map& map, FrameId last_frame);

 private:
  FrameRecord* record_of(FrameId frame);

  std::vector<FrameRecord> records_;
  Trajectory online_;
  std::map<KeyframeId, FrameId> frames_;          // of keyframes
  std::map<KeyframeId, std::int64_t> stamps_ns_;  // of keyframes
  std::vector<std::size_t> origins_;
  std::size_t first_changed_ = 0;
};

}  // namespace placegraph
