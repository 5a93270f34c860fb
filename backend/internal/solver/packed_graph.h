#pragma once
#include <placegraph/graph/pose_graph/landmark_graph.h>

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
  struct Observation {
    int node, point;  ///< positions in `poses`
    Eigen::Vector3d p_node;
    Eigen::Matrix3d information;
  };
  /// T_world_node; of a LandmarkGraph then its points, as poses that do not turn, and last the
  /// world, held: measured poses are edges from it.
  std::vector<Group> poses;
  /// Nodes that do not move: the fixed ones, and the first of every component that neither a fixed
  /// node nor a measured position ties to the world.
  std::vector<char> held;
  std::vector<Edge> edges;
  std::vector<Position> positions;
  std::vector<Observation> observations;
};

/// `graph` must have passed PoseGraph::check and be of the kind of `Group`.
template <class Group>
PackedGraph<Group> pack(const PoseGraph& graph);
/// The same of SE2 and SE3 with what is beside the poses. Edges of priors belong to constraint -1.
template <class Group>
PackedGraph<Group> pack(const LandmarkGraph& graph);

/// The place of a point, which is kept as a pose that does not turn; z is 0 in the plane.
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
