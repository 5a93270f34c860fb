#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace placegraph::synthetic {

/// Adds `count` loops behind the others that are not true, as where two places look alike: each has
/// the measurement and the information of a loop of the graph drawn at random, but between two
/// poses drawn at random that stand more than a tenth of the map's diagonal apart. Where the poses
/// are drifted odometry, what is apart there may be near in truth: optimize them first. Throws
/// ArgumentError: a negative count or one above a million, a graph without loops, poses of which
/// hardly any two are that far apart.
void add_false_loops(PoseGraph& graph, int count, std::uint64_t seed);

/// Puts the constraints into a random order.
void shuffle_constraints(PoseGraph& graph, std::uint64_t seed);

}  // namespace placegraph::synthetic
