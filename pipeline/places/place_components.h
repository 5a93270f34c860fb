#pragma once
#include <placegraph/graph/loop.h>
#include <placegraph/pipeline/places/place_partition.h>

#include <vector>

namespace placegraph {

/// Joins components that a loop connects: the younger one is moved as a whole to the pose given by
/// the loop, and takes the scale of the older one.
void join_components(const KeyframeChain& chain, const std::vector<Loop>& loops,
                     PlacePartition& partition);

/// Gives new components to places that no link or loop connects (any more) to the first place of
/// their component.
void split_components(const KeyframeChain& chain, const std::vector<Loop>& loops,
                      PlacePartition& partition);

/// Converts components in which the scale of a place is known to metres. The first place of a
/// component keeps its position. If the scales of all track segments are known, the scales of
/// places become 1.
void normalize_scales(const KeyframeChain& chain, PlacePartition& partition);

}  // namespace placegraph
