#pragma once
#include <placegraph/backend/incremental/graph_change.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <memory>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

class IncrementalEngine;

/// Keeps a pose graph optimized while nodes and constraints arrive.
/// The cost is the sum of weight * rho(e^T Omega e), over SE(2), SE(3) or Sim(3), as the first node
/// is.
///
/// A step is Gauss-Newton on a factor L of the normal matrix that is updated where something
/// changed. The gradient g is exact at the present poses, the normal matrix may be that of earlier
/// ones: edges are linearized in the frames of their nodes, where a correction that moves the whole
/// map by metres changes little. As L y = -g is kept up to date, |y|^2 predicts before any pose
/// moves how far the cost can fall; nothing is solved as long as that is less than asked for.
///
/// A node that arrives without being joined to earlier ones starts a component at its own pose. The
/// first constraint that joins two components moves one of them as a whole so that the constraint
/// holds: the one that has neither a fixed node nor a position constraint, else the later one. So
/// the pose given with a node that is joined by a constraint of the same step does not matter
/// (odometry is tried first). In a component with neither, the first node is held.
///
/// A node that loses all its constraints stays where it is until it is joined again.
///
/// The same calls give the same bits.
class IncrementalOptimizer {
 public:
  /// An empty graph; throws ArgumentError as IncrementalOptions::check.
  explicit IncrementalOptimizer(const IncrementalOptions& options = {});
  /// Begins with a graph at its poses, which are the start of later iterations.
  /// Throws ArgumentError as IncrementalOptions::check and PoseGraph::check.
  IncrementalOptimizer(const IncrementalOptions& options, const PoseGraph& graph);
  ~IncrementalOptimizer();
  IncrementalOptimizer(IncrementalOptimizer&&) noexcept;
  IncrementalOptimizer& operator=(IncrementalOptimizer&&) noexcept;

  /// Makes all changes and iterates to IncrementalOptions::excess.
  /// Throws ArgumentError as PoseGraph::check would for the graph with the change, for an unknown
  /// constraint, a revision that joins other nodes, or a weight that is negative or not finite;
  /// nothing is changed then.
  IncrementalStep apply(const GraphChange& change);
  /// Adds nodes and constraints in one step, as apply().
  IncrementalStep add(const std::vector<PoseNode>& nodes,
                      const std::vector<Constraint>& constraints) {
    return apply({nodes, constraints, {}, {}});
  }
  /// Gives constraints other weights in one step, as apply().
  IncrementalStep reweight(const std::vector<ConstraintWeight>& weights) {
    return apply({{}, {}, {}, weights});
  }
  /// Gives a constraint the weight 0, which can be undone by reweight().
  IncrementalStep remove_constraint(int constraint) { return reweight({{constraint, 0.0}}); }
  /// Iterates to IncrementalOptions::final_excess, for the last poses of a run.
  IncrementalStep finish();

  /// The kind of all poses; nothing before the first node.
  std::optional<PoseKind> kind() const;
  /// The present pose T_world_node; nothing for an unknown node.
  std::optional<Pose> pose(NodeId node_id) const;
  /// The graph whose cost is minimized: all nodes, and the constraints of positive weight.
  /// Both are in the order in which they came. Where the weight is not 1, information and width of
  /// the kernel are scaled by it.
  PoseGraph graph() const;
  /// Number of constraints ever added, those of weight 0 included.
  int constraints() const;
  /// The latest measurement of a constraint; throws ArgumentError for an unknown number.
  const Constraint& constraint(int number) const;
  /// Sum of weight * rho(e^T Omega e) at the present poses; 0 without a graph.
  double cost() const;
  /// Joint covariance of the tangents of some nodes, in their order.
  /// It comes from the factor as it is, which may be that of earlier poses; zero for held nodes.
  /// Throws ArgumentError for an unknown node.
  Eigen::MatrixXd covariance(const std::vector<NodeId>& node_ids) const;

  /// Covariance of the pose T_from_to in its own right tangent.
  /// Throws ArgumentError for an unknown node and for nodes of two components.
  Information relative_covariance(NodeId from, NodeId to) const;

 private:
  IncrementalOptions options_;
  std::unique_ptr<IncrementalEngine> engine_;  ///< none before the first node
};

}  // namespace placegraph
