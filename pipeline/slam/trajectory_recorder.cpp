#include <placegraph/pipeline/slam/trajectory_recorder.h>

#include <algorithm>

namespace placegraph {

bool TrajectoryRecorder::accepts(const Frame& frame) const {
  return empty() || (frame.stamp_ns > newest().stamp_ns && frame.id > newest().frame);
}

void TrajectoryRecorder::begin(const Frame& frame) {
  records_.push_back({frame.id, frame.stamp_ns, std::nullopt, std::nullopt, 0});
}

void TrajectoryRecorder::record(KeyframeId keyframe, const SE3& T_keyframe_frame, int inliers) {
  records_.back().keyframe = keyframe;
  records_.back().T_keyframe_frame = T_keyframe_frame;
  records_.back().inliers = inliers;
}

void TrajectoryRecorder::finish(const std::optional<SE3>& T_map_cam, int component) {
  StampedPose pose{newest().stamp_ns, std::nullopt};
  if (T_map_cam) pose.T_world_body = T_map_cam->isometry();
  online_.push_back(pose);
  online_component_.push_back(component);
}

void TrajectoryRecorder::explain(const std::optional<double>& confidence,
                                 const std::string& reason) {
  records_.back().confidence = confidence;
  records_.back().reason = reason;
}

std::vector<StampedPose> TrajectoryRecorder::online(int component, std::size_t first) const {
  std::vector<StampedPose> poses(online_.begin() + static_cast<std::ptrdiff_t>(first),
                                 online_.end());
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (online_component_[first + i] != component) poses[i].T_world_body.reset();
  return poses;
}

/// Number of the first record of a frame from `first` on; it and the later ones may be changed.
std::size_t TrajectoryRecorder::change_from(FrameId first) {
  const auto record = std::ranges::lower_bound(records_, first, {}, &FrameRecord::frame);
  const auto number = static_cast<std::size_t>(record - records_.begin());
  first_changed_ = std::min(first_changed_, number);
  return number;
}

/// The record of a frame, to be changed; null for a frame without one.
FrameRecord* TrajectoryRecorder::record_of(FrameId frame) {
  const std::size_t number = change_from(frame);
  return number < records_.size() && records_[number].frame == frame ? &records_[number] : nullptr;
}

void TrajectoryRecorder::add_keyframe(const NewKeyframe& keyframe) {
  frames_[keyframe.id] = keyframe.frame.id;
  stamps_ns_[keyframe.id] = keyframe.frame.stamp_ns;
  if (FrameRecord* record = record_of(keyframe.frame.id)) {
    record->keyframe = keyframe.id;
    record->T_keyframe_frame = SE3();
  }
}

void TrajectoryRecorder::correct(const std::vector<PosedFrame>& posed, KeyframeId first_new,
                                 const LocalMap& map) {
  for (const auto& [frame, T_odom_cam] : posed)
    if (FrameRecord* record = record_of(frame)) {
      if (!record->keyframe || *record->keyframe < map.first()) record->keyframe = first_new;
      record->T_keyframe_frame = map.pose(*record->keyframe).inverse() * T_odom_cam;
    }
}

void TrajectoryRecorder::correct_motions(const std::map<KeyframeId, Vector6d>& corrections,
                                         const std::function<std::optional<SE3>(KeyframeId)>&
                                             motion_into) {
  for (FrameRecord& record : records_) {
    if (!record.keyframe || !record.T_keyframe_frame) continue;
    const KeyframeId from = *record.keyframe, to(from.value() + 1);
    const auto correction = corrections.find(to);
    const auto begin = stamps_ns_.find(from), end = stamps_ns_.find(to);
    if (correction == corrections.end() || begin == stamps_ns_.end() || end == stamps_ns_.end() ||
        record.stamp_ns <= begin->second || record.stamp_ns >= end->second)
      continue;
    const std::optional<SE3> T_from_to = motion_into(to);
    if (!T_from_to) continue;
    const double share = static_cast<double>(record.stamp_ns - begin->second) /
                         static_cast<double>(end->second - begin->second);
    const SE3 T_frame_to = record.T_keyframe_frame->inverse() * *T_from_to;
    record.T_keyframe_frame =
        *record.T_keyframe_frame * SE3::exp(share * T_frame_to.adjoint() * correction->second);
    first_changed_ = 0;
  }
}

void TrajectoryRecorder::rescale(KeyframeId first_keyframe, double factor) {
  for (FrameRecord& record : records_)
    if (record.keyframe && *record.keyframe >= first_keyframe && record.T_keyframe_frame)
      record.T_keyframe_frame =
          SE3(record.T_keyframe_frame->rotation(), factor * record.T_keyframe_frame->translation());
  first_changed_ = 0;
}

void TrajectoryRecorder::remove_poses(FrameId first, const std::string& reason) {
  for (std::size_t i = change_from(first); i < records_.size(); ++i) {
    records_[i].keyframe.reset();
    records_[i].T_keyframe_frame.reset();
    records_[i].confidence.reset();
    records_[i].reason = reason;
  }
}

void TrajectoryRecorder::begin_at_origin(bool rotated) {
  if (!rotated) {
    for (const std::size_t origin : origins_) {
      online_[origin].T_world_body.reset();
      first_changed_ = std::min(first_changed_, origin);
    }
    origins_.clear();
  }
  origins_.push_back(records_.size() - 1);
}

void TrajectoryRecorder::take_up(const Map& map, FrameId last_frame, int component) {
  for (const Keyframe& keyframe : map.keyframes) {
    frames_[keyframe.id] = keyframe.frame;
    stamps_ns_[keyframe.id] = keyframe.stamp_ns;
  }
  for (std::size_t i = 0; i < map.frames.size() && map.frames[i].frame <= last_frame; ++i) {
    records_.push_back(map.frames[i]);
    online_.push_back(map.trajectory_online.poses.at(i));
    online_component_.push_back(component);
  }
  report_all();
}

}  // namespace placegraph
