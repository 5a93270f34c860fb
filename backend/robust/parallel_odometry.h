#pragma once
#include <placegraph/backend/robust/loop_clusters.h>

namespace placegraph {

/// Keeps one of several odometry edges between the same two nodes; the others become loops.
/// At most one of them can be accepted without a test. The edge that agrees best with its
/// surroundings stays odometry; the loops may be rejected. The misfit of an edge is the sum of
/// log(1 + chi2 / (dof * noise_scale)), the cost of a Cauchy distribution, over the shortest rings
/// of loops and odometry across the step, the poses of the graph and, for three and more edges, the
/// other edges. With this cost a false loop, which fits none of the edges, has little influence.
/// The result does not depend on the order of the edges. Returns the number of edges that became
/// loops.
template <class Group>
int set_parallel_odometry_apart(PackedGraph<Group>& graph, const LoopSupportOptions& options);

}  // namespace placegraph
