#include <placegraph/backend/solver/packed_graph.h>
#include <placegraph/graph/core/disjoint_sets.h>
#include <placegraph/graph/pose_graph/node_index.h>

#include <algorithm>

namespace placegraph {
namespace {

std::vector<char> fixed_nodes(const PoseGraph& graph) {
  std::vector<char> fixed;
  for (const PoseNode& node : graph.nodes) fixed.push_back(node.fixed);
  return fixed;
}

template <class Group>
Group at(const Eigen::Vector3d& position) {
  if constexpr (Group::kDof == 3)
    return Group(position.x(), position.y(), 0);
  else
    return Group(SE3(SO3(), position));
}

/// Dimension of the errors of a graph without that of its nodes; see
/// GraphComponents::degrees_of_freedom.
template <class Group>
int degrees_of_freedom(const PackedGraph<Group>& graph, const GraphComponents& components) {
  constexpr int dim = Group::kDof == 3 ? 2 : 3;
  std::vector<int> size(graph.poses.size(), Group::kDof);  // of the unknowns of every node
  for (const auto& observation : graph.observations) size[observation.point] = dim;
  int dof = dim * static_cast<int>(graph.observations.size());
  for (const auto& edge : graph.edges) dof += edge.weight != 0 ? Group::kDof : 0;
  for (std::size_t i = 0; i < size.size(); ++i) dof -= components.anchor[i] ? 0 : size[i];
  std::vector<int> of_positions(components.first.size());
  for (const auto& position : graph.positions)
    of_positions[components.component[position.node]] += dim;
  for (std::size_t k = 0; k < of_positions.size(); ++k)
    dof += components.floating[k] ? std::max(0, of_positions[k] - Group::kDof) : of_positions[k];
  return dof;
}

}  // namespace

template <class Group>
GraphComponents find_components(const PackedGraph<Group>& graph, std::vector<char> fixed) {
  DisjointSets sets(fixed.size());
  int links = static_cast<int>(graph.observations.size());
  for (const auto& edge : graph.edges) {
    if (edge.weight == 0) continue;
    sets.join(edge.from, edge.to);
    ++links;
  }
  for (const auto& observation : graph.observations) sets.join(observation.node, observation.point);
  GraphComponents result;
  result.component = sets.numbers();
  for (int i = 0; i < static_cast<int>(fixed.size()); ++i)
    if (sets.root(i) == i) result.first.push_back(i);
  std::vector<char> has_held(result.first.size());
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (fixed[i]) has_held[result.component[i]] = true;
  result.floating.assign(result.first.size(), false);
  for (const auto& position : graph.positions) {
    const int component = result.component[position.node];
    result.floating[component] = !has_held[component];
  }
  result.held = std::move(fixed);
  for (std::size_t k = 0; k < result.first.size(); ++k)
    if (!has_held[k] && !result.floating[k]) result.held[result.first[k]] = true;
  result.anchor = result.held;
  for (std::size_t k = 0; k < result.first.size(); ++k)
    if (result.floating[k]) result.anchor[result.first[k]] = true;
  const auto others = std::count(result.anchor.begin(), result.anchor.end(), 0);
  result.redundant = links - static_cast<int>(others);
  result.degrees_of_freedom = degrees_of_freedom(graph, result);
  return result;
}

namespace {

template <class Group>
PackedGraph<Group> pack_poses(const PoseGraph& graph) {
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
  return packed;
}

}  // namespace

template <class Group>
PackedGraph<Group> pack(const PoseGraph& graph) {
  PackedGraph<Group> packed = pack_poses<Group>(graph);
  packed.components = find_components(packed, fixed_nodes(graph));
  return packed;
}

template <class Group>
PackedGraph<Group> pack(const LandmarkGraph& graph) {
  PackedGraph<Group> packed = pack_poses<Group>(graph.poses);
  const NodeIndex nodes = graph.poses.index_by_id();
  const auto first_point = static_cast<int>(packed.poses.size());
  std::vector<char> fixed = fixed_nodes(graph.poses);
  std::vector<NodeId> ids;
  for (const GraphPoint& point : graph.points) {
    ids.push_back(point.id);
    packed.poses.push_back(at<Group>(point.position_world));
    fixed.push_back(point.fixed);
  }
  const NodeIndex points(ids);
  for (const PointObservation& observation : graph.observations)
    packed.observations.push_back({nodes.at(observation.node),
                                   first_point + points.at(observation.point),
                                   observation.position_node, observation.information});
  const auto world = static_cast<int>(packed.poses.size());
  packed.poses.emplace_back();
  fixed.push_back(true);
  for (const PosePriorConstraint& prior : graph.priors)
    packed.edges.push_back({world,
                            nodes.at(prior.node),
                            -1,
                            false,
                            std::get<Group>(prior.T_world_node).inverse(),
                            prior.information,
                            {}});
  packed.components = find_components(packed, std::move(fixed));
  return packed;
}

template <class Group>
void unpack(const PackedGraph<Group>& packed, PoseGraph& graph) {
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
    if (!packed.components.held[i]) graph.nodes[i].T_world_node = packed.poses[i];
}

namespace {

template <class Graph>
GraphComponents packed_components(PoseKind kind, const Graph& graph) {
  switch (kind) {
    case PoseKind::kSE2:
      return pack<SE2>(graph).components;
    case PoseKind::kSE3:
      return pack<SE3>(graph).components;
    case PoseKind::kSim3:
      break;
  }
  return pack<Sim3>(graph).components;
}

}  // namespace

GraphComponents find_components(const PoseGraph& graph) {
  return packed_components(graph.kind(), graph);
}

GraphComponents find_components(const LandmarkGraph& graph) {
  return packed_components(graph.poses.kind(), graph);
}

#define PLACEGRAPH_INSTANTIATE(Group)                                                     \
  template PackedGraph<Group> pack(const PoseGraph&);                                     \
  template PackedGraph<Group> pack(const LandmarkGraph&);                                 \
  template GraphComponents find_components(const PackedGraph<Group>&, std::vector<char>); \
  template void unpack(const PackedGraph<Group>&, PoseGraph&);
PLACEGRAPH_INSTANTIATE(SE2)
PLACEGRAPH_INSTANTIATE(SE3)
PLACEGRAPH_INSTANTIATE(Sim3)
#undef PLACEGRAPH_INSTANTIATE

}  // namespace placegraph
