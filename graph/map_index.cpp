#include <placegraph/graph/core/error.h>
#include <placegraph/graph/map_index.h>

namespace placegraph {

MapIndex::MapIndex(const Map& map) {
  const std::vector<int> joined = map.place_graph.joined_components();
  for (std::size_t i = 0; i < joined.size(); ++i)
    places_.emplace(map.place_graph.places[i].id, Entry{&map.place_graph.places[i], joined[i]});
  for (const Keyframe& keyframe : map.keyframes) keyframes_.emplace(keyframe.id, &keyframe);
}

Sim3 MapIndex::Location::S_map_keyframe() const {
  return place->S_map_place() *
         PlaceMember{keyframe->id, keyframe->T_place_keyframe, keyframe->scale}.S_place_keyframe();
}

std::optional<MapIndex::Location> MapIndex::find(KeyframeId id) const {
  const auto keyframe = keyframes_.find(id);
  if (keyframe == keyframes_.end()) return std::nullopt;
  const auto place = places_.find(keyframe->second->place);
  if (place == places_.end()) return std::nullopt;
  return Location{keyframe->second, place->second.place, place->second.component};
}

MapIndex::Location MapIndex::of(const FrameRecord& record) const {
  if (!record.keyframe)
    throw ArgumentError("map: frame " + to_string(record.frame) + " has a pose and no keyframe");
  if (const std::optional<Location> location = find(*record.keyframe)) return *location;
  const auto keyframe = keyframes_.find(*record.keyframe);
  if (keyframe == keyframes_.end())
    throw ArgumentError("map: frame " + to_string(record.frame) + " refers to keyframe " +
                        to_string(*record.keyframe) + ", which is not there");
  throw ArgumentError("map: keyframe " + to_string(*record.keyframe) + " refers to place " +
                      to_string(keyframe->second->place) + ", which is not there");
}

}  // namespace placegraph
