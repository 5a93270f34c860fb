#pragma once
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/internal/solver/packed_graph.h>

namespace placegraph {

/// Sets the poses to those of the graph as it grew: nodes along the odometry, a hundredth at a
/// time, each time brought to the minimum of what is there (IncrementalOptimizer). Where loops are
/// short against the drift between them, that ends in a lower minimum than a descent from the
/// odometry. False, and the poses are as before, if it would eliminate more than
/// `most_factorizations` times as many nodes as there are, or the minimum of some part cannot be
/// computed.
template <class Group>
bool incremental_initialization_of(PackedGraph<Group>& graph, RotationError rotation_error,
                                   double most_factorizations);

}  // namespace placegraph
