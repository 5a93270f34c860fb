#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The number of direct transitions of the camera from one place to another.
struct PlaceTransition {
  PlaceId from, to;  ///< two different places
  int count = 0;     ///< pairs of consecutive frames, at least 1
};

/// Counts the transitions between consecutive frames of a map, sorted by `from`, then `to`.
/// Lost frames and changes of the component are no transitions. Throws ArgumentError if a frame's
/// keyframe is not in the map.
std::vector<PlaceTransition> place_transitions(const Map& map);

}  // namespace placegraph
