#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/loop.h>
#include <placegraph/pipeline/internal/places/place_partition.h>
#include <placegraph/pipeline/places/place_options.h>

#include <optional>
#include <vector>

namespace placegraph {

/// The earlier place that a keyframe at `S_map_here` stands in by the map: the nearest of its
/// component within `reach` [in the map's scale] and within its own reach that looks the same way.
/// Places that odometry reaches from `keyframe` along a short path do not count: they are
/// neighbours, no places that were visited before.
std::optional<PlaceId> earlier_place_in_reach(const KeyframeChain& chain,
                                              const PlacePartition& partition,
                                              const PlaceOptions& options, KeyframeId keyframe,
                                              const Sim3& S_map_here, double reach);

/// Whether `keyframe`, the newest of the chain and not yet of the partition, belongs to the part of
/// its predecessor: it is within reach of the anchor and, once loops have led back to known places,
/// in the same earlier place as the anchor. So where a path is travelled again, its parts end where
/// those of the first time did.
bool in_reach_of_segment(const KeyframeChain& chain, const PlacePartition& partition,
                         const std::vector<Loop>& loops, const PlaceOptions& options,
                         KeyframeId keyframe, double median_depth);

}  // namespace placegraph
