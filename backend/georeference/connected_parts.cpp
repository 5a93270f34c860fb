#include <placegraph/backend/georeference/antenna_trajectory.h>
#include <placegraph/backend/georeference/connected_parts.h>
#include <placegraph/graph/pose_graph/node_index.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>

#include <cmath>

namespace placegraph {

Pose placed(const Sim3& T_enu_map, const Pose& T_map_node) {
  if (const SE2* T = std::get_if<SE2>(&T_map_node)) {
    const SE3 rigid = SE3(T_enu_map.rotation(), T_enu_map.translation()) * rigid_part(*T);
    const Eigen::Matrix3d R = rigid.rotation().matrix();
    return SE2(rigid.translation().x(), rigid.translation().y(), std::atan2(R(1, 0), R(0, 0)));
  }
  if (const SE3* T = std::get_if<SE3>(&T_map_node))
    return SE3(T_enu_map.rotation(), T_enu_map.translation()) * *T;
  return T_enu_map * std::get<Sim3>(T_map_node);
}

PoseGraph subgraph_of(const PoseGraph& graph, const std::vector<char>& keep) {
  PoseGraph part;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
    if (keep[i]) part.nodes.push_back(graph.nodes[i]);
  const auto index = part.index_by_id();
  for (const Constraint& constraint : graph.constraints) {
    const auto* edge = std::get_if<RelativePoseConstraint>(&constraint);
    if (edge && index.contains(edge->from) && index.contains(edge->to))
      part.constraints.push_back(constraint);
  }
  return part;
}

}  // namespace placegraph
