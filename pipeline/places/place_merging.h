#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/loop.h>
#include <placegraph/pipeline/places/place_options.h>
#include <placegraph/pipeline/places/place_partition.h>

#include <functional>
#include <vector>

namespace placegraph {

/// Two places that are the same.
struct PlaceMerger {
  PlaceId older, younger;
  Matrix7d covariance = Matrix7d::Zero();  ///< covariance of S_older_younger in its right tangent
};

/// Covariance of S_from_to of two places in its right tangent.
using PlaceCovariance = std::function<Matrix7d(PlaceId from, PlaceId to)>;

/// Value of `first_open` if no keyframe is being refined any more.
inline constexpr KeyframeId kNoneOpen = kAfterAll;

/// Selects the places to merge, each in one merger at most, as a merger changes the estimate of its
/// place. Candidates are the places at the two ends of a loop that agrees with the map, and places
/// whose positions in the map are within earlier places. Two candidates are merged if they are
/// within reach of each other, have the same viewing direction, their relative pose is sufficiently
/// certain, they were not separated before, and all their keyframes are older than `first_open`.
/// While keyframes are open, only the newest loops and places are examined.
std::vector<PlaceMerger> find_mergers(const KeyframeChain& chain, const PlacePartition& partition,
                                      const std::vector<Loop>& loops, const PlaceOptions& options,
                                      const PlaceCovariance& covariance, KeyframeId first_open);

/// Indices (in PlacePartition::merged()) of mergers that odometry contradicts, in ascending order:
/// the residuals of the odometry edges out of the merged segments are larger than chance allows,
/// and three times larger than those of edges elsewhere in the map.
std::vector<std::size_t> contradicted_mergers(const KeyframeChain& chain,
                                              const PlacePartition& partition);

}  // namespace placegraph
