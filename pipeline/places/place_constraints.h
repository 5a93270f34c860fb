#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/loop.h>
#include <placegraph/pipeline/places/place_optimizer.h>
#include <placegraph/pipeline/places/place_options.h>
#include <placegraph/pipeline/places/place_partition.h>

#include <vector>

namespace placegraph {

/// A measured motion between the anchors of two segments.
struct PlaceEdge {
  PlaceConstraint::Key key;
  KeyframeId from_segment, to_segment;
  Sim3 S_from_to;
  Matrix7d covariance = Matrix7d::Zero();  ///< in the right tangent
  ConstraintSource source = ConstraintSource::kOdometry;
};

/// Edges along the links of the keyframes from `since` on: one between consecutive anchors of each
/// track segment, with the accumulated covariances of the links between them (or with the motion
/// covariance stored in the partition), and one for each track segment that is linked to an earlier
/// one.
std::vector<PlaceEdge> link_edges(const KeyframeChain& chain, const PlacePartition& partition,
                                  KeyframeId since);
/// The edge of `loop`, which has this number, transferred from its keyframes to the anchors of
/// their segments.
PlaceEdge loop_edge(const KeyframeChain& chain, const PlacePartition& partition, const Loop& loop,
                    std::size_t number);
/// The edge of a motion measured by another sensor [m], which has this number; nothing if the scale
/// of one of the two track segments is unknown.
std::optional<PlaceEdge> motion_edge(const KeyframeChain& chain, const PlaceHistory::Motion& motion,
                                     std::size_t number);

/// The constraint between the places of the two segments: S_A_B = S_A_a S_a_b S_B_b^-1 with the
/// covariances of all three. It is over SE(3) if the scales of all track segments are known,
/// otherwise over Sim(3), and has no robust kernel.
RelativePoseConstraint constraint_between_places(const PlacePartition& partition,
                                                 const PlaceEdge& edge, bool all_scales_known);

/// All constraints that depend on keyframes from `since` on, with their robust kernels; without a
/// measurement if both ends are in one place.
std::vector<PlaceConstraint> place_constraints(const KeyframeChain& chain,
                                               const PlacePartition& partition,
                                               const std::vector<Loop>& loops,
                                               const std::vector<PlaceHistory::Motion>& motions,
                                               const PlaceOptions& options, KeyframeId since);

}  // namespace placegraph
