#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <vector>

namespace placegraph {

/// T_enu_map in front of a pose of the map; a node of SE(2) keeps to the plane.
Pose placed(const Sim3& T_enu_map, const Pose& T_map_node);

/// The part of a graph whose nodes are kept: relative poses that join dropped ones go too, as do
/// measured positions.
PoseGraph kept_part(const PoseGraph& graph, const std::vector<char>& keep);

}  // namespace placegraph
