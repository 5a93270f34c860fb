#pragma once
#include <placegraph/backend/solver/graph_components.h>
#include <placegraph/graph/pose_graph/landmark_graph.h>

namespace placegraph {

/// A pose graph of one group for the solvers, with positions instead of ids and without variants.
/// The order of nodes and constraints is the same.
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
    double weight = 1;  ///< weight of the edge's cost, set by robust methods (GNC); 0 excludes it
  };
  struct Position {
    int node;
    int constraint;
    Eigen::Vector3d position_world, lever_arm;
    Eigen::Matrix3d information;
    RobustKernel kernel;
    double weight = 1;
  };
  struct Observation {
    int node, point;  ///< positions in `poses`
    Eigen::Vector3d p_node;
    Eigen::Matrix3d information;
  };
  /// T_world_node; for a LandmarkGraph then its points, as poses without rotation, and last the
  /// world, which is held: measured poses are edges from it.
  std::vector<Group> poses;
  std::vector<Edge> edges;
  std::vector<Position> positions;
  std::vector<Observation> observations;
  GraphComponents components;  ///< of the weights with which the graph was packed
};

/// `graph` must have passed PoseGraph::check and be of the kind of `Group`.
template <class Group>
PackedGraph<Group> pack(const PoseGraph& graph);
/// Packs a landmark graph of SE2 or SE3 with its points and priors; edges of priors have constraint
/// -1.
template <class Group>
PackedGraph<Group> pack(const LandmarkGraph& graph);

/// The components of a packed graph; `fixed` says of every node whether it is fixed.
template <class Group>
GraphComponents find_components(const PackedGraph<Group>& graph, std::vector<char> fixed);

/// The position of a point, which is stored as a pose without rotation; z is 0 in the plane.
inline Eigen::Vector3d point_of(const SE2& T) {
  return {T.translation().x(), T.translation().y(), 0};
}
template <class Group>
Eigen::Vector3d point_of(const Group& T) {
  return T.translation();
}

/// Writes the poses of the nodes that are not held into `graph`, from which `packed` was made.
template <class Group>
void unpack(const PackedGraph<Group>& packed, PoseGraph& graph);

}  // namespace placegraph
