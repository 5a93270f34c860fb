#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/tracking/odometry_update.h>

#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace placegraph {

/// Records every frame twice: relative to a keyframe, so that refinement of the keyframe corrects
/// it, and as the online pose at the time of processing.
class TrajectoryRecorder {
 public:
  /// Begins the next frame, without a pose. Ids and stamps must increase (see accepts()).
  void begin(const Frame& frame);
  bool accepts(const Frame& frame) const;
  /// Sets the pose of the newest frame relative to a keyframe.
  void record(KeyframeId keyframe, const SE3& T_keyframe_frame, int inliers);
  /// Ends the newest frame, with its pose in the frame of a component of the map, if it has one.
  void finish(const std::optional<SE3>& T_map_cam, int component);
  /// Sets how far the newest frame's pose can be trusted, or why it has none.
  void explain(const std::optional<double>& confidence, const std::string& reason);

  /// Adds a frame that has become a keyframe.
  void add_keyframe(const NewKeyframe& keyframe);
  /// Corrects poses of frames in the odometry frame of a track segment whose keyframes are in
  /// `map`. Poses of frames before the segment become relative to keyframe `first_new`.
  void correct(const std::vector<PosedFrame>& posed, KeyframeId first_new, const LocalMap& map);
  /// Corrects the frames between two keyframes as the motion between these is corrected in its
  /// right tangent, in proportion to the time since the first. Motions by the keyframe at their
  /// end, from the one before; `motion_into`: before the correction, nothing where it is unknown.
  void correct_motions(const std::map<KeyframeId, Vector6d>& corrections,
                       const std::function<std::optional<SE3>(KeyframeId)>& motion_into);
  /// Multiplies all lengths relative to keyframes from `first_keyframe` on by `factor`.
  void rescale(KeyframeId first_keyframe, double factor);

  /// Removes the poses of the frames from `first` on, for this reason.
  void remove_poses(FrameId first, const std::string& reason);
  /// Makes the newest frame the origin of the map, as the first view of a monocular camera that
  /// waits for its second view. `rotated`: the camera has only rotated since the previous first
  /// view, whose pose remains valid. Otherwise the poses of earlier frames are removed.
  void begin_at_origin(bool rotated);

  bool empty() const { return records_.empty(); }
  /// Nothing before the first keyframe.
  std::optional<KeyframeId> newest_keyframe() const {
    return frames_.empty() ? std::nullopt : std::optional(frames_.rbegin()->first);
  }
  const FrameRecord& newest() const { return records_.back(); }
  bool newest_has_keyframe() const { return records_.back().keyframe.has_value(); }
  const std::vector<FrameRecord>& records() const { return records_; }
  /// The online poses from position `first` on of frames that were in a component when they were
  /// processed; other frames have none.
  std::vector<StampedPose> online(int component, std::size_t first = 0) const;
  FrameId frame_of(KeyframeId keyframe) const { return frames_.at(keyframe); }
  std::int64_t stamp_ns_of(KeyframeId keyframe) const { return stamps_ns_.at(keyframe); }

  /// First record that has changed since the records were last reported.
  std::size_t first_changed() const { return first_changed_; }
  void report_all() { first_changed_ = records_.size(); }
  /// Takes over the frames of a saved map up to `last_frame`. Its online poses are of `component`.
  void take_up(const Map& map, FrameId last_frame, int component);

 private:
  std::size_t change_from(FrameId first);
  FrameRecord* record_of(FrameId frame);

  std::vector<FrameRecord> records_;
  std::vector<StampedPose> online_;               // poses in the frames of their components
  std::vector<int> online_component_;             // component of each online pose
  std::map<KeyframeId, FrameId> frames_;          // frame of each keyframe
  std::map<KeyframeId, std::int64_t> stamps_ns_;  // time stamp of each keyframe
  std::vector<std::size_t> origins_;
  std::size_t first_changed_ = 0;
};

}  // namespace placegraph
