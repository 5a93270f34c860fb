#include <placegraph/graph/core/error.h>
#include <placegraph/graph/map.h>
#include <placegraph/graph/map_index.h>

#include <algorithm>
#include <map>

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

std::vector<MapComponent> Map::components() const {
  const MapIndex index(*this);
  std::map<int, MapComponent> found;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!frames[i].T_keyframe_frame) continue;
    const int number = index.of(frames[i]).component;
    MapComponent& component =
        found.try_emplace(number, MapComponent{number, false, 0, i, i}).first->second;
    ++component.posed;
    component.last = i;
  }
  std::vector<MapComponent> result;
  for (const auto& [number, component] : found) result.push_back(component);
  if (!result.empty()) std::ranges::max_element(result, {}, &MapComponent::posed)->main = true;
  return result;
}

int Map::main_component() const {
  for (const MapComponent& component : components())
    if (component.main) return component.number;
  return 0;
}

Trajectory Map::trajectory_optimized(int component) const {
  const MapIndex index(*this);
  Trajectory trajectory;
  trajectory.poses.reserve(frames.size());
  for (const FrameRecord& record : frames) {
    StampedPose& pose = trajectory.poses.emplace_back();
    pose.stamp_ns = record.stamp_ns;
    if (!record.T_keyframe_frame) continue;
    const MapIndex::Location at = index.of(record);
    if (at.component != component) continue;
    // The scale moves positions; a camera's own pose has none.
    const Sim3 S_map_keyframe = at.S_map_keyframe();
    pose.T_world_body = SE3(S_map_keyframe.rotation() * record.T_keyframe_frame->rotation(),
                            S_map_keyframe * record.T_keyframe_frame->translation())
                            .isometry();
  }
  return trajectory;
}

}  // namespace placegraph
