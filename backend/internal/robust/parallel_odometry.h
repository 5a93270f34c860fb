#pragma once
#include <placegraph/backend/internal/robust/loop_clusters.h>

namespace placegraph {

/// Of several odometry edges between the same two nodes at most one can be trusted blindly. The one
/// that agrees best with what surrounds it stays odometry, the others become loops, which may be
/// rejected. Asked are the shortest rings of loops and odometry that lead over the step, the poses
/// of the graph and, of three and more edges, the others: each says with log(1 + chi2 / (dof *
/// noise_scale)) how badly an edge fits (the cost of a Cauchy distribution), so that what fits none
/// of the edges, a false loop, says little. Nothing depends on the order of the edges. Returns the
/// number of edges that became loops.
template <class Group>
int set_parallel_odometry_apart(PackedGraph<Group>& graph, const LoopSupportOptions& options);

}  // namespace placegraph
