#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// How often the camera went straight from one place to another.
struct PlaceTransition {
  PlaceId from, to;
  int count = 0;
};

/// Of the consecutive frames of a map, by `from`, then `to`; frames that are lost or in another
/// component interrupt. Throws ArgumentError if a frame's keyframe is not in the map.
std::vector<PlaceTransition> place_transitions(const Map& map);

}  // namespace placegraph
