#pragma once
#include <placegraph/graph/loop.h>
#include <placegraph/pipeline/internal/places/place_partition.h>

#include <vector>

namespace placegraph {

/// Makes one component of those that a loop connects: the younger one moves as a whole to where the
/// loop says, and takes the scale of the older one.
void join_components(const KeyframeChain& chain, const std::vector<Loop>& loops,
                     PlacePartition& partition);

/// Gives a component in which the scale of a place is known that scale: its lengths become metres.
/// Its first place stays where it is. Where the scales of all runs are known, no place has a scale
/// of its own.
void normalize_scales(const KeyframeChain& chain, PlacePartition& partition);

}  // namespace placegraph
