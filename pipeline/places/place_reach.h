#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/loop.h>
#include <placegraph/pipeline/places/place_options.h>
#include <placegraph/pipeline/places/place_partition.h>

#include <optional>
#include <vector>

namespace placegraph {

/// The earlier place that contains a keyframe at `S_map_here` according to the map: the nearest
/// place of its component within `reach` [in the map's scale] and within its own reach that has the
/// same viewing direction. Places that odometry reaches from `keyframe` along a short path are
/// excluded: they are neighbours, not places visited before.
std::optional<PlaceId> earlier_place_in_reach(const KeyframeChain& chain,
                                              const PlacePartition& partition,
                                              const PlaceOptions& options, KeyframeId keyframe,
                                              const Sim3& S_map_here, double reach);

/// Whether `keyframe`, the newest of the chain and not yet part of the partition, belongs to the
/// segment of its predecessor: it is within reach of the anchor and, once loops have led back to
/// known places, in the same earlier place as the anchor. Where a path is travelled again, its
/// segments therefore end where those of the first traversal did.
bool in_reach_of_segment(const KeyframeChain& chain, const PlacePartition& partition,
                         const std::vector<Loop>& loops, const PlaceOptions& options,
                         KeyframeId keyframe, double median_depth);

}  // namespace placegraph
