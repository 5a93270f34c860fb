#include <placegraph/graph/core/error.h>
#include <placegraph/graph/map.h>

#include <unordered_map>

namespace placegraph {

const Keyframe* Map::find_keyframe(KeyframeId id) const {
  // Ids usually count from 0.
  const std::int64_t at = id.value();
  if (at >= 0 && at < static_cast<std::int64_t>(keyframes.size()) && keyframes[at].id == id)
    return &keyframes[at];
  for (const Keyframe& keyframe : keyframes)
    if (keyframe.id == id) return &keyframe;
  return nullptr;
}

Sim3 Map::S_map_keyframe(KeyframeId id) const {
  const Keyframe* keyframe = find_keyframe(id);
  if (!keyframe) throw ArgumentError("map: keyframe " + to_string(id) + " is not there");
  const Place* place = place_graph.find(keyframe->place);
  if (!place)
    throw ArgumentError("map: keyframe " + to_string(id) + " refers to place " +
                        to_string(keyframe->place) + ", which is not there");
  return place->S_map_place() *
         PlaceMember{id, keyframe->T_place_keyframe, keyframe->scale}.S_place_keyframe();
}

Trajectory Map::trajectory_optimized() const {
  // Poses of other components than the first are in frames of their own.
  const std::vector<int> component = place_graph.joined_components();
  std::unordered_map<PlaceId, const Place*> place_by_id;
  std::unordered_map<PlaceId, bool> belongs;
  for (std::size_t i = 0; i < component.size(); ++i) {
    place_by_id.emplace(place_graph.places[i].id, &place_graph.places[i]);
    belongs.emplace(place_graph.places[i].id, component[i] == 0);
  }
  std::unordered_map<KeyframeId, const Keyframe*> keyframe_by_id;
  for (const Keyframe& keyframe : keyframes) keyframe_by_id.emplace(keyframe.id, &keyframe);

  Trajectory trajectory;
  trajectory.poses.reserve(frames.size());
  for (const FrameRecord& record : frames) {
    StampedPose& pose = trajectory.poses.emplace_back();
    pose.stamp_ns = record.stamp_ns;
    if (!record.T_keyframe_frame) continue;
    if (!record.keyframe)
      throw ArgumentError("map: frame " + to_string(record.frame) + " has a pose and no keyframe");
    const auto keyframe = keyframe_by_id.find(*record.keyframe);
    if (keyframe == keyframe_by_id.end())
      throw ArgumentError("map: frame " + to_string(record.frame) + " refers to keyframe " +
                          to_string(*record.keyframe) + ", which is not there");
    const auto place = place_by_id.find(keyframe->second->place);
    if (place == place_by_id.end())
      throw ArgumentError("map: keyframe " + to_string(*record.keyframe) + " refers to place " +
                          to_string(keyframe->second->place) + ", which is not there");
    if (!belongs.at(place->first)) continue;
    // The scale moves positions; a camera's own pose has none.
    const Keyframe& at = *keyframe->second;
    const Sim3 S_map_keyframe =
        place->second->S_map_place() *
        PlaceMember{at.id, at.T_place_keyframe, at.scale}.S_place_keyframe();
    pose.T_world_body = SE3(S_map_keyframe.rotation() * record.T_keyframe_frame->rotation(),
                            S_map_keyframe * record.T_keyframe_frame->translation())
                            .isometry();
  }
  return trajectory;
}

}  // namespace placegraph
