#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/loop.h>
#include <placegraph/pipeline/places/place_partition.h>

#include <map>
#include <vector>

namespace placegraph {

/// For every place the places to which links and loops connect it; one that several connect comes
/// several times.
std::map<PlaceId, std::vector<PlaceId>> place_neighbours(const KeyframeChain& chain,
                                                         const PlacePartition& partition,
                                                         const std::vector<Loop>& loops);

/// Length of the shortest path from place to place along links and loops, in the map's scale
/// (Dijkstra 1959); infinite if there is none.
double shortest_path(const KeyframeChain& chain, const PlacePartition& partition,
                     const std::vector<Loop>& loops, PlaceId from, PlaceId to);

}  // namespace placegraph
