#pragma once
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/solver/packed_graph.h>

namespace placegraph {

/// Sets the poses by incremental optimization along the odometry.
/// A hundredth of the nodes is added at a time, and the present part is optimized
/// (IncrementalOptimizer). If loops are short compared with the drift between them, the result is a
/// lower minimum than that of a descent from the odometry. False, with unchanged poses, if it would
/// eliminate more than `most_factorizations` times the number of nodes, or if the minimum of some
/// part cannot be computed.
template <class Group>
bool initialize_incrementally(PackedGraph<Group>& graph, RotationError rotation_error,
                              double most_factorizations);

}  // namespace placegraph
