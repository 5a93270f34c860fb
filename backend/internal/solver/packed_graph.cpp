#include <placegraph/backend/internal/solver/packed_graph.h>
#include <placegraph/graph/internal/core/disjoint_sets.h>
#include <placegraph/graph/pose_graph/node_index.h>

namespace placegraph {
namespace {

template <class Group>
std::vector<char> held_nodes(std::vector<char> held, const PackedGraph<Group>& packed) {
  DisjointSets pieces(held.size());
  for (const auto& edge : packed.edges) pieces.join(edge.from, edge.to);
  for (const auto& observation : packed.observations)
    pieces.join(observation.node, observation.point);
  std::vector<char> anchored(held.size());
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i]) anchored[pieces.root(static_cast<int>(i))] = true;
  for (const auto& position : packed.positions) anchored[pieces.root(position.node)] = true;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (const int root = pieces.root(static_cast<int>(i)); !anchored[root])
      held[i] = anchored[root] = true;
  return held;
}

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
    return Group(SO3(), position);
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
  packed.held = held_nodes(fixed_nodes(graph), packed);
  return packed;
}

template <class Group>
PackedGraph<Group> pack(const LandmarkGraph& graph) {
  PackedGraph<Group> packed = pack<Group>(graph.poses);
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
  packed.held = held_nodes(std::move(fixed), packed);
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
template PackedGraph<SE2> pack(const LandmarkGraph&);
template PackedGraph<SE3> pack(const LandmarkGraph&);
template void unpack(const PackedGraph<SE2>&, PoseGraph&);
template void unpack(const PackedGraph<SE3>&, PoseGraph&);
template void unpack(const PackedGraph<Sim3>&, PoseGraph&);

}  // namespace placegraph
