#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/landmark_graph.h>
#include <placegraph/graph/pose_graph/node_index.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>

#include <string>

namespace placegraph {
namespace {

void check_prior(const PosePriorConstraint& prior, PoseKind kind, const NodeIndex& nodes,
                 const std::string& name) {
  require(nodes.contains(prior.node), name + "unknown node " + to_string(prior.node));
  require(kind_of(prior.T_world_node) == kind, name + "of another kind than the nodes");
  require(position_of(prior.T_world_node).allFinite(), name + "pose is not finite");
  require(prior.information.rows() == degrees_of_freedom(kind),
          name + "the size of the information does not fit the nodes");
  if (const char* fault = fault_of(prior.information)) throw ArgumentError(name + fault);
}

void check_observation(const PointObservation& observation, const NodeIndex& nodes,
                       const NodeIndex& points, const std::string& name) {
  require(nodes.contains(observation.node), name + "unknown node " + to_string(observation.node));
  require(points.contains(observation.point),
          name + "unknown point " + to_string(observation.point));
  require(observation.position_node.allFinite(), name + "position is not finite");
  if (const char* fault = fault_of(observation.information)) throw ArgumentError(name + fault);
}

}  // namespace

void LandmarkGraph::check() const {
  poses.check();
  if (has_poses_alone()) return;
  const PoseKind kind = poses.kind();
  require(kind != PoseKind::kSim3, "landmark graph: similarities have no priors and landmarks");
  const NodeIndex nodes = poses.index_by_id();
  std::vector<NodeId> ids;
  for (const GraphPoint& point : points) {
    ids.push_back(point.id);
    require(point.position_world.allFinite(),
            "point " + to_string(point.id) + ": position is not finite");
    require(!nodes.contains(point.id), "point " + to_string(point.id) + ": a node has its id");
  }
  const NodeIndex by_id(ids);
  for (std::size_t i = 0; i < ids.size(); ++i)
    require(by_id.find(ids[i]) == static_cast<int>(i),
            "point " + to_string(ids[i]) + " is there twice");
  for (std::size_t i = 0; i < priors.size(); ++i)
    check_prior(priors[i], kind, nodes, "prior " + std::to_string(i) + ": ");
  for (std::size_t i = 0; i < observations.size(); ++i)
    check_observation(observations[i], nodes, by_id, "observation " + std::to_string(i) + ": ");
}

}  // namespace placegraph
