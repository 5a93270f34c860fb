#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace placegraph::synthetic {

/// Appends `count` false loops, as between places of similar appearance. Each has the measurement
/// and the information of a loop of the graph drawn at random, but joins two poses drawn at random
/// that are more than a tenth of the map's diagonal apart. If the poses are drifted odometry, poses
/// that are apart there may be close in truth: optimize them first. Throws ArgumentError: a
/// negative count or one above a million, a graph without loops, poses of which hardly any two are
/// that far apart.
void add_false_loops(PoseGraph& graph, int count, std::uint64_t seed);

/// Shuffles the constraints.
void shuffle_constraints(PoseGraph& graph, std::uint64_t seed);

}  // namespace placegraph::synthetic
