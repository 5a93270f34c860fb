#include <placegraph/backend/solver/packed_graph.h>
#include <placegraph/graph/core/disjoint_sets.h>

namespace placegraph {
namespace {

template <class Group>
std::vector<char> held_nodes(const PoseGraph& graph, const PackedGraph<Group>& packed) {
  DisjointSets pieces(graph.nodes.size());
  for (const auto& edge : packed.edges) pieces.join(edge.from, edge.to);
  std::vector<char> held(graph.nodes.size()), anchored(graph.nodes.size());
  for (std::size_t i = 0; i < held.size(); ++i) {
    held[i] = graph.nodes[i].fixed;
    if (held[i]) anchored[pieces.root(static_cast<int>(i))] = true;
  }
  for (const auto& position : packed.positions) anchored[pieces.root(position.node)] = true;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (const int root = pieces.root(static_cast<int>(i)); !anchored[root])
      held[i] = anchored[root] = true;
  return held;
}

}  // namespace

template <class Group>
PackedGraph<Group> pack(const PoseGraph& graph) {
  const NodeIndex index = graph.index_by_id();
  PackedGraph<Group> packed;
  packed.poses.reserve(graph.nodes.size());
  for (const PoseNode& node : graph.nodes)
    packed.poses.push_back(std::get<Group>(node.T_world_node));
  packed.edges.reserve(graph.constraints.size());
  for (std::size_t i = 0; i < graph.constraints.size(); ++i) {
    if (const auto* relative = std::get_if<RelativePoseConstraint>(&graph.constraints[i])) {
      packed.edges.push_back({index.at(relative->from), index.at(relative->to), static_cast<int>(i),
                              relative->source == ConstraintSource::kOdometry,
                              std::get<Group>(relative->T_from_to).inverse(), relative->information,
                              relative->kernel});
    } else {
      const auto& position = std::get<PositionConstraint>(graph.constraints[i]);
      packed.positions.push_back({index.at(position.node), static_cast<int>(i),
                                  position.position_world, position.lever_arm, position.information,
                                  position.kernel});
    }
  }
  packed.held = held_nodes(graph, packed);
  return packed;
}

template <class Group>
void unpack(const PackedGraph<Group>& packed, PoseGraph& graph) {
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
    if (!packed.held[i]) graph.nodes[i].T_world_node = packed.poses[i];
}

template PackedGraph<SE2> pack(const PoseGraph&);
template PackedGraph<SE3> pack(const PoseGraph&);
template PackedGraph<Sim3> pack(const PoseGraph&);
template void unpack(const PackedGraph<SE2>&, PoseGraph&);
template void unpack(const PackedGraph<SE3>&, PoseGraph&);
template void unpack(const PackedGraph<Sim3>&, PoseGraph&);

}  // namespace placegraph
