#include <placegraph/graph/core/error.h>
#include <placegraph/graph/map.h>

#include <unordered_map>

namespace placegraph {

const Keyframe* Map::find_keyframe(std::int64_t id) const {
  // Ids usually count from 0.
  if (id >= 0 && id < static_cast<std::int64_t>(keyframes.size()) && keyframes[id].id == id)
    return &keyframes[id];
  for (const Keyframe& keyframe : keyframes)
    if (keyframe.id == id) return &keyframe;
  return nullptr;
}

Trajectory Map::trajectory_optimized() const {
  // Poses of other components than the first are in frames of their own.
  const std::vector<int> component = place_graph.joined_components();
  std::unordered_map<std::int64_t, const Place*> place_by_id;
  std::unordered_map<std::int64_t, bool> belongs;
  for (std::size_t i = 0; i < component.size(); ++i) {
    place_by_id.emplace(place_graph.places[i].id, &place_graph.places[i]);
    belongs.emplace(place_graph.places[i].id, component[i] == 0);
  }
  std::unordered_map<std::int64_t, const Keyframe*> keyframe_by_id;
  for (const Keyframe& keyframe : keyframes) keyframe_by_id.emplace(keyframe.id, &keyframe);

  Trajectory trajectory;
  trajectory.poses.reserve(frames.size());
  for (const FrameRecord& record : frames) {
    StampedPose& pose = trajectory.poses.emplace_back();
    pose.stamp_ns = record.stamp_ns;
    if (!record.T_keyframe_frame) continue;
    const auto keyframe = keyframe_by_id.find(record.keyframe);
    if (keyframe == keyframe_by_id.end())
      throw ArgumentError("map: frame " + std::to_string(record.frame) + " hangs on keyframe " +
                          std::to_string(record.keyframe) + ", which is not there");
    const auto place = place_by_id.find(keyframe->second->place);
    if (place == place_by_id.end())
      throw ArgumentError("map: keyframe " + std::to_string(record.keyframe) + " hangs on place " +
                          std::to_string(keyframe->second->place) + ", which is not there");
    if (!belongs.at(place->first)) continue;
    pose.T_world_body =
        (place->second->T_map_place * keyframe->second->T_place_keyframe * *record.T_keyframe_frame)
            .isometry();
  }
  return trajectory;
}

}  // namespace placegraph
