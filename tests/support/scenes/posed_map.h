#pragma once
#include <placegraph/graph/map.h>

#include <vector>

namespace placegraph::test {

/// A map in metres of keyframes 0, 1, ... at these poses, each a place, taken 100 ns apart.
inline Map posed_map(const std::vector<SE3>& poses) {
  Map map;
  map.metric = true;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto id = static_cast<std::int64_t>(i);
    Keyframe keyframe;
    keyframe.id = KeyframeId(id), keyframe.frame = FrameId(id), keyframe.place = PlaceId(id),
    keyframe.stamp_ns = 100 * id;
    map.keyframes.push_back(keyframe);
    Place place;
    place.id = PlaceId(id), place.anchor_keyframe = KeyframeId(id), place.T_map_place = poses[i];
    place.members.push_back({KeyframeId(id), SE3(), 1});
    map.place_graph.places.push_back(place);
  }
  return map;
}

}  // namespace placegraph::test
