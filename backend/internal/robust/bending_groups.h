#pragma once
#include <placegraph/backend/internal/solver/subset_solver.h>

#include <vector>

namespace placegraph {

/// The noise of the rings of neighbouring loops, before any loop is judged.
struct RingNoise {
  double scale;  ///< variance of the noise relative to the information
  double gate;   ///< squared error of a loop, weighted by the information, that noise explains
};

/// Drops one group of loops that bends the odometry until its own loops fit; false if none does.
/// Graduated non-convexity judges a loop by its own error and may keep such a group. If the cost of
/// the edges with weight is far above the noise of the rings, the groups with the largest errors
/// are left out in turn, until the cost of the rest falls by far more than the gates of the group's
/// loops. `groups`: positions in `graph.edges`. The poses are those of the rest then. A group that
/// alone connects a part of the graph to the rest is kept.
template <class Group>
bool drop_bending_group(PackedGraph<Group>& graph, const std::vector<std::vector<int>>& groups,
                        const RingNoise& noise, RotationError rotation_error,
                        SubsetSolver<Group>& solver);

}  // namespace placegraph
