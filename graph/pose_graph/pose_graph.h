#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/pose_graph/constraint.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

class NodeIndex;

struct PoseNode {
  NodeId id;
  Pose T_world_node;
  bool fixed = false;
};

/// Poses and what is known of them. A plain value; ids are any integers, order is kept.
struct PoseGraph {
  std::vector<PoseNode> nodes;
  std::vector<Constraint> constraints;

  PoseKind kind() const;  ///< of the first node; SE3 if there is none

  /// Throws ArgumentError: mixed kinds, duplicate ids, a constraint on an unknown node or
  /// of a node with itself, a kernel of no positive width, non-finite
  /// values, information of the wrong size, asymmetric, indefinite (smallest eigenvalue below -1e-9
  /// of the largest) or all zero.
  void check() const;
  /// id -> position in `nodes`.
  NodeIndex index_by_id() const;
  /// For every node the number of its connected component; numbers count from 0 in node order.
  std::vector<int> components() const;
  /// For every node the constraint that reaches it in a breadth-first spanning forest; -1 for
  /// roots, which are the first nodes of the components. Other constraints than odometry are used
  /// only where odometry leads no further.
  std::vector<int> spanning_tree() const;
};

/// Sets every pose that is not fixed by the measurements along the spanning tree, from its roots,
/// which stay where they are. Throws ArgumentError for a constraint on an unknown node.
void integrate_odometry(PoseGraph& graph);

}  // namespace placegraph
