#pragma once
#include <placegraph/backend/elimination/elimination_tree.h>
#include <placegraph/backend/incremental/graph_change.h>
#include <placegraph/backend/incremental/incremental_components.h>
#include <placegraph/backend/incremental/incremental_terms.h>
#include <placegraph/graph/core/ids.h>

#include <unordered_map>
#include <utility>
#include <vector>

namespace placegraph {

/// Nodes and constraints of an incremental graph, their terms and their elimination tree.
/// The terms are at the current poses and are written into the tree. Constraints of weight zero are
/// removed from everything except the list of constraints. The caller has checked all inputs.
template <class Group>
class IncrementalGraph {
 public:
  using Tree = EliminationTree<Group::kDof>;
  explicit IncrementalGraph(RotationError rotation_error) : rotation_error_(rotation_error) {}

  void add_node(const PoseNode& node);
  /// `poses_hold`: constraints that connect components move neither component.
  void add_constraints(const std::vector<Constraint>& constraints, bool poses_hold);
  void revise(const ConstraintRevision& revision);
  /// Sets weights one after the other.
  void set_weights(const std::vector<ConstraintWeight>& weights);

  int nodes() const { return static_cast<int>(nodes_.size()); }
  int constraints() const { return static_cast<int>(constraints_.size()); }
  const Constraint& constraint(int number) const { return constraints_[number]; }
  int find(NodeId node_id) const;  ///< position; -1: unknown
  NodeId id(int node) const { return ids_[node]; }
  const Group& pose(int node) const { return nodes_[node].T_world_node; }
  bool together(int a, int b) const { return components_.together(a, b); }
  /// Cost of the terms at the current poses.
  double cost() const;
  PackedGraph<Group> packed() const;
  PoseGraph graph() const;

  Tree& tree() { return tree_; }
  const Tree& tree() const { return tree_; }
  /// Moves nodes by their steps in the tree; move_back undoes that.
  void move(const std::vector<int>& nodes);
  void move_back(const std::vector<int>& nodes);
  void set_poses(const std::vector<Group>& T_world_nodes);
  /// Writes the changed gradients into the tree.
  void set_gradients();
  /// Edges of the nodes moved in the last iteration.
  const std::vector<int>& visited() const { return visited_; }
  /// Linearizes those of the edges again whose Jacobians have changed by more than `change`;
  /// returns their number.
  int relinearize(const std::vector<int>& edges, double change);
  int relinearize_all(double change);

 private:
  using Tangent = typename Group::Tangent;

  struct Node {
    Group T_world_node, T_before;  ///< current pose, and that before the current iteration
    std::vector<int> edges, positions;
    bool gradient_stale = false;
  };
  struct Edge : EdgeTerm<Group> {
    int term = -1;  ///< term of the tree
    bool visited = false;
  };
  struct Position : PositionTerm<Group> {
    int term = -1;
    bool visited = false;
  };

  void set_weight(const ConstraintWeight& weight);
  void attach(int constraint, double weight);
  void detach(int constraint);
  void add_edge(const RelativePoseConstraint& constraint, int number, double weight);
  void add_position(const PositionConstraint& constraint, int number, double weight);
  void join(const Edge& edge);
  std::vector<int> reached(int start, int other, std::vector<char>& seen) const;
  void split_removed();
  void apply_held();
  void mark_gradient(int node) {
    if (!std::exchange(nodes_[node].gradient_stale, true)) gradient_stale_.push_back(node);
  }
  void evaluate(int edge);
  void linearize(int edge);
  void evaluate_position(int position);
  void evaluate_around(const std::vector<int>& nodes);

  RotationError rotation_error_;
  std::vector<NodeId> ids_;
  std::unordered_map<NodeId, int> index_;
  std::vector<char> fixed_;
  std::vector<Constraint> constraints_;
  std::vector<int> place_;  ///< place of every constraint in edges_ or positions_; -1: weight 0
  std::vector<Node> nodes_;
  IncrementalComponents components_;
  std::vector<Edge> edges_;
  std::vector<double> edge_costs_;  ///< cost of every edge, contiguous
  std::vector<Position> positions_;
  std::vector<int> free_edges_, free_positions_;  ///< unused places
  std::vector<int> visited_, gradient_stale_;     ///< edges of the iteration; nodes
  std::vector<std::pair<int, int>> removed_;      ///< nodes of edges removed since the last split
  bool poses_hold_ = false;                       ///< connecting components moves neither
  Tree tree_;
};

}  // namespace placegraph
