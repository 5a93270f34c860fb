#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace placegraph {

/// A pose graph of one group with ids resolved to positions and every variant opened: what the
/// solvers of this folder work on. The order of nodes and constraints is kept.
template <class Group>
struct PackedGraph {
  struct Edge {
    int from, to;     ///< positions in `poses`
    int constraint;   ///< position in PoseGraph::constraints
    bool odometry;    ///< ConstraintSource::kOdometry: never to be rejected
    Group T_to_from;  ///< inverse of the measured T_from_to: error = Log(T_to_from * T_from^-1 *
                      ///< T_to)
    typename Group::Jacobian information;
    RobustKernel kernel;
    double weight = 1;  ///< of the edge's cost, set by whoever reweights (GNC); 0 leaves it out
  };
  struct Position {
    int node;
    int constraint;
    Eigen::Vector3d position_world, lever_arm;
    Eigen::Matrix3d information;
    RobustKernel kernel;
    double weight = 1;
  };
  std::vector<Group> poses;  ///< T_world_node
  /// Nodes that do not move: the fixed ones, and the first of every component that neither a fixed
  /// node nor a measured position ties to the world.
  std::vector<char> held;
  std::vector<Edge> edges;
  std::vector<Position> positions;
};

/// `graph` must have passed PoseGraph::check and be of the kind of `Group`.
template <class Group>
PackedGraph<Group> pack(const PoseGraph& graph);

/// Writes the poses of the nodes that are not held into `graph`, from which `packed` was made.
template <class Group>
void unpack(const PackedGraph<Group>& packed, PoseGraph& graph);

}  // namespace placegraph
