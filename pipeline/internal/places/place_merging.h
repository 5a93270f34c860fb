#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/loop.h>
#include <placegraph/pipeline/internal/places/place_partition.h>
#include <placegraph/pipeline/places/place_options.h>

#include <functional>
#include <vector>

namespace placegraph {

/// Two places that are one.
struct PlaceMerger {
  PlaceId older, younger;
  Matrix7d covariance = Matrix7d::Zero();  ///< of S_older_younger in its right tangent
};

/// Covariance of S_from_to of two places in its right tangent.
using PlaceCovariance = std::function<Matrix7d(PlaceId from, PlaceId to)>;

/// As `first_open`: no keyframe is being refined any more.
inline constexpr KeyframeId kNoneOpen = kAfterAll;

/// The places that may be merged, each in one merger at most, as a merger changes what is known of
/// its place. Candidates are the places at the two ends of a loop that the map agrees with, and
/// places that stand in earlier ones by the map. Of these, two are merged if they are within reach
/// of each other, look the same way, are known well enough to each other, were not separated
/// before, and all their keyframes are older than `first_open`. While keyframes are open only the
/// newest loops and places are looked at.
std::vector<PlaceMerger> find_mergers(const KeyframeChain& chain, const PlacePartition& partition,
                                      const std::vector<Loop>& loops, const PlaceOptions& options,
                                      const PlaceCovariance& covariance, KeyframeId first_open);

/// The numbers (in PlacePartition::merged()) of mergers that odometry contradicts, in ascending
/// order: the odometry edges out of the merged parts are further off than chance allows, and three
/// times further than edges are elsewhere in the map.
std::vector<std::size_t> contradicted_mergers(const KeyframeChain& chain,
                                              const PlacePartition& partition);

}  // namespace placegraph
