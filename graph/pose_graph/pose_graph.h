#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/pose_graph/constraint.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

class NodeIndex;

/// A pose to be estimated.
struct PoseNode {
  NodeId id;           ///< unique in its graph
  Pose T_world_node;   ///< the estimate
  bool fixed = false;  ///< optimization leaves the pose as it is
};

/// Poses and constraints on them; a plain value. Ids are any integers in any order.
struct PoseGraph {
  std::vector<PoseNode> nodes;          ///< all of one kind; results keep their order
  std::vector<Constraint> constraints;  ///< between nodes, and on positions of nodes

  /// The kind of the first node; kSE3 if there is none.
  PoseKind kind() const;

  /// Throws ArgumentError naming the first entry that is invalid.
  /// Invalid are mixed kinds, duplicate ids, a constraint on an unknown node or of a node with
  /// itself, a kernel of no positive width, values that are not finite, and information of the
  /// wrong size, asymmetric, indefinite (smallest eigenvalue below -1e-9 of the largest) or all
  /// zero.
  void check() const;
  /// Positions in `nodes` by id.
  NodeIndex index_by_id() const;
  /// For every node the number of its connected component; numbers count from 0 in node order.
  /// Throws ArgumentError for a constraint on an unknown node.
  std::vector<int> components() const;
  /// For every node the constraint that reaches it in a breadth-first spanning forest.
  /// -1 for roots, which are the first nodes of the components. Constraints from other sources than
  /// odometry are used only to reach nodes that odometry does not reach. Throws as components().
  std::vector<int> spanning_tree() const;
};

/// Sets the poses by chaining the measurements along the spanning tree.
/// Roots and fixed nodes keep their poses. Throws ArgumentError for a constraint on an unknown
/// node.
void integrate_odometry(PoseGraph& graph);

}  // namespace placegraph
