#include <placegraph/graph/pose_graph/graph_parts.h>
#include <placegraph/graph/pose_graph/node_index.h>

#include <algorithm>

namespace placegraph {

std::vector<GraphPart> split_components(const PoseGraph& graph) {
  const std::vector<int> component = graph.components();
  const NodeIndex index = graph.index_by_id();
  const int count =
      component.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end());
  std::vector<GraphPart> parts(count);
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    GraphPart& part = parts[component[i]];
    part.graph.nodes.push_back(graph.nodes[i]);
    part.nodes.push_back(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < graph.constraints.size(); ++i) {
    const auto* relative = std::get_if<RelativePoseConstraint>(&graph.constraints[i]);
    const NodeId id =
        relative ? relative->from : std::get<PositionConstraint>(graph.constraints[i]).node;
    GraphPart& part = parts[component[index.at(id)]];
    part.graph.constraints.push_back(graph.constraints[i]);
    part.constraints.push_back(static_cast<int>(i));
  }
  return parts;
}

}  // namespace placegraph
