#pragma once
#include <placegraph/backend/incremental/graph_change.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <memory>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

class IncrementalEngine;

/// Keeps a pose graph optimized while nodes and constraints are added.
/// The cost is the sum of weight * rho(e^T Omega e). The first node determines the group: SE(2),
/// SE(3) or Sim(3).
///
/// A step is Gauss-Newton with a factor L of the normal matrix that is updated where the graph
/// changed. The gradient g is exact at the current poses; the normal matrix may be that of earlier
/// poses, because edges are linearized in the frames of their nodes, where a correction that moves
/// the whole map by metres changes little. L y = -g is kept up to date, so |y|^2 predicts the
/// decrease of the cost before any pose moves; no system is solved while this decrease is smaller
/// than requested.
///
/// A node that no constraint connects to earlier ones starts a component at its own pose. The first
/// constraint between two components moves one of them as a whole so that the constraint is
/// satisfied: the one that has neither a fixed node nor a position constraint, else the later one.
/// So the given pose of a node has no effect if a constraint of the same step connects it (odometry
/// is tried first). In a component with neither a fixed node nor a position constraint, the first
/// node is held.
///
/// A node that loses all its constraints keeps its pose until it is connected again.
///
/// The same calls give bitwise identical results.
class IncrementalOptimizer {
 public:
  /// Starts with an empty graph; throws ArgumentError as IncrementalOptions::check.
  explicit IncrementalOptimizer(const IncrementalOptions& options = {});
  /// Starts with a graph, whose poses are the initial values of later iterations.
  /// Throws ArgumentError as IncrementalOptions::check and PoseGraph::check.
  IncrementalOptimizer(const IncrementalOptions& options, const PoseGraph& graph);
  ~IncrementalOptimizer();
  IncrementalOptimizer(IncrementalOptimizer&&) noexcept;
  IncrementalOptimizer& operator=(IncrementalOptimizer&&) noexcept;

  /// Applies all changes and iterates to IncrementalOptions::excess.
  /// Throws ArgumentError as PoseGraph::check would for the graph with the change, for an unknown
  /// constraint, a revision that connects other nodes, or a weight that is negative or not finite;
  /// the graph is unchanged then.
  IncrementalStep apply(const GraphChange& change);
  /// Adds nodes and constraints in one step, see apply().
  IncrementalStep add(const std::vector<PoseNode>& nodes,
                      const std::vector<Constraint>& constraints) {
    return apply({nodes, constraints, {}, {}});
  }
  /// Changes the weights of constraints in one step, see apply().
  IncrementalStep reweight(const std::vector<ConstraintWeight>& weights) {
    return apply({{}, {}, {}, weights});
  }
  /// Sets the weight of a constraint to 0; reweight() can undo this.
  IncrementalStep remove_constraint(int constraint) { return reweight({{constraint, 0.0}}); }
  /// Iterates to IncrementalOptions::final_excess, for the last poses of a run.
  IncrementalStep finish();

  /// The kind of all poses; empty before the first node.
  std::optional<PoseKind> kind() const;
  /// The current pose T_world_node; empty for an unknown node.
  std::optional<Pose> pose(NodeId node_id) const;
  /// The graph whose cost is minimized: all nodes, and the constraints of positive weight.
  /// Both are in the order in which they were added. If the weight is not 1, information and width
  /// of the kernel are scaled by it.
  PoseGraph graph() const;
  /// Number of constraints ever added, including those of weight 0.
  int constraints() const;
  /// The latest measurement of a constraint; throws ArgumentError for an unknown number.
  const Constraint& constraint(int number) const;
  /// Sum of weight * rho(e^T Omega e) at the current poses; 0 without a graph.
  double cost() const;
  /// Joint covariance of the tangents of the given nodes, in their order.
  /// It is computed from the current factor, which may be that of earlier poses; zero for held
  /// nodes. Throws ArgumentError for an unknown node.
  Eigen::MatrixXd covariance(const std::vector<NodeId>& node_ids) const;

  /// Covariance of the pose T_from_to in its own right tangent.
  /// Throws ArgumentError for an unknown node and for nodes of different components.
  Information relative_covariance(NodeId from, NodeId to) const;

 private:
  IncrementalOptions options_;
  std::unique_ptr<IncrementalEngine> engine_;  ///< null before the first node
};

}  // namespace placegraph
