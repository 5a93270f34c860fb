#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/loop.h>
#include <placegraph/pipeline/internal/places/place_partition.h>

namespace placegraph {

/// Length of the shortest path from place to place along links and loops, in the map's scale
/// (Dijkstra 1959); infinite if there is none.
double shortest_path(const KeyframeChain& chain, const PlacePartition& partition,
                     const std::vector<Loop>& loops, PlaceId from, PlaceId to);

}  // namespace placegraph
