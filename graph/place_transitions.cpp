#include <placegraph/graph/core/error.h>
#include <placegraph/graph/place_transitions.h>

#include <map>
#include <unordered_map>

namespace placegraph {

std::vector<PlaceTransition> place_transitions(const Map& map) {
  const std::vector<int> components = map.place_graph.joined_components();
  std::unordered_map<PlaceId, int> component_of;
  for (std::size_t i = 0; i < components.size(); ++i)
    component_of[map.place_graph.places[i].id] = components[i];
  std::unordered_map<KeyframeId, PlaceId> place_of;
  for (const Keyframe& keyframe : map.keyframes) place_of[keyframe.id] = keyframe.place;

  std::map<std::pair<PlaceId, PlaceId>, int> counts;
  std::optional<PlaceId> here;
  for (const FrameRecord& frame : map.frames) {
    if (!frame.T_keyframe_frame) {
      here.reset();
      continue;
    }
    require(frame.keyframe.has_value(),
            "map: frame " + to_string(frame.frame) + " has a pose and no keyframe");
    const auto place = place_of.find(*frame.keyframe);
    require(place != place_of.end(), "map: keyframe " + to_string(*frame.keyframe) + " of frame " +
                                         to_string(frame.frame) + " is not there");
    const PlaceId next = place->second;
    if (here && *here != next && component_of[*here] == component_of[next]) ++counts[{*here, next}];
    here = next;
  }
  std::vector<PlaceTransition> transitions;
  for (const auto& [ends, count] : counts) transitions.push_back({ends.first, ends.second, count});
  return transitions;
}

}  // namespace placegraph
