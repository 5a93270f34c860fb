#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <vector>

namespace placegraph {

/// A pose of the map transformed by T_enu_map; a node of SE(2) stays in the plane.
Pose placed(const Sim3& T_enu_map, const Pose& T_map_node);

/// The subgraph of the kept nodes, without measured positions and edges to dropped nodes.
PoseGraph subgraph_of(const PoseGraph& graph, const std::vector<char>& keep);

}  // namespace placegraph
