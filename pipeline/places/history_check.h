#pragma once
#include <placegraph/graph/place_graph.h>
#include <placegraph/graph/place_history.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Checks that a run could go on with the places of a saved map.
///
/// Throws ArgumentError, which names the place or the keyframe, if the history contradicts them.
void check_history(const std::vector<Place>& places, const PlaceHistory& history);

}  // namespace placegraph
