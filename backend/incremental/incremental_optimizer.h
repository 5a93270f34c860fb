#pragma once
#include <placegraph/backend/incremental/graph_change.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <memory>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

class IncrementalEngine;

/// Keeps a pose graph at the minimum of sum weight * rho(e^T Omega e) while nodes and constraints
/// arrive: SE(2), SE(3) or Sim(3), as the first node is.
///
/// A step is Gauss-Newton on a factor that is updated where something changed (EliminationTree).
/// The gradient is exact at the present poses, the normal matrix may be that of earlier ones: edges
/// are linearized in the frames of their nodes, where a correction that moves the whole map by
/// metres changes little. As L y = -g is kept up to date, |y|^2 tells before any pose moves how
/// much cost there is to gain; nothing is solved as long as that is less than asked for.
///
/// A node that arrives without being joined to earlier ones starts a component at its own pose. The
/// first constraint that joins two components moves one of them as a whole to where the constraint
/// says: the one that neither a fixed node nor a position ties to the world, else the later one; so
/// the pose given with a node that is joined by a constraint of the same step does not matter
/// (odometry is tried first). Of a component that nothing ties to the world the first node is held.
///
/// A node that loses all its constraints stays where it is and takes part in nothing until it is
/// joined again.
///
/// The same calls give the same bits.
class IncrementalOptimizer {
 public:
  /// Throws ArgumentError as IncrementalOptions::check.
  explicit IncrementalOptimizer(const IncrementalOptions& options = {});
  /// Begins with a graph at its poses, which are iterated on from there. Throws ArgumentError as
  /// PoseGraph::check too.
  IncrementalOptimizer(const IncrementalOptions& options, const PoseGraph& graph);
  ~IncrementalOptimizer();
  IncrementalOptimizer(IncrementalOptimizer&&) noexcept;
  IncrementalOptimizer& operator=(IncrementalOptimizer&&) noexcept;

  /// Throws ArgumentError as PoseGraph::check would for the graph with the change, for an unknown
  /// number, a revision that joins other nodes, or a weight that is negative or not finite; nothing
  /// is changed then.
  IncrementalStep apply(const GraphChange& change);
  IncrementalStep add(const std::vector<PoseNode>& nodes,
                      const std::vector<Constraint>& constraints) {
    return apply({nodes, constraints, {}, {}});
  }
  /// Gives constraints other weights, all in one step.
  IncrementalStep reweight(const std::vector<ConstraintWeight>& weights) {
    return apply({{}, {}, {}, weights});
  }
  IncrementalStep remove_constraint(int constraint) { return reweight({{constraint, 0.0}}); }
  /// Iterates to final_excess.
  IncrementalStep finish();

  std::optional<PoseKind> kind() const;            ///< none before the first node
  std::optional<Pose> pose(NodeId node_id) const;  ///< T_world_node; none if unknown
  /// All nodes in the order they came and, in theirs, the constraints whose weight is not 0: the
  /// graph whose cost is minimized, so with information and width of the kernel scaled where the
  /// weight is not 1.
  PoseGraph graph() const;
  int constraints() const;  ///< how many were ever given
  /// As it is measured by now. Throws ArgumentError for an unknown number.
  const Constraint& constraint(int number) const;
  double cost() const;
  /// Covariance of the right perturbations of the nodes, in their order, from the factor as it is;
  /// zero for held ones. Throws ArgumentError for an unknown node.
  Eigen::MatrixXd covariance(const std::vector<NodeId>& node_ids) const;

  /// Of T_from_to in its own right tangent. Throws ArgumentError for an unknown node and for nodes
  /// that nothing joins.
  Information relative_covariance(NodeId from, NodeId to) const;

 private:
  IncrementalOptions options_;
  std::unique_ptr<IncrementalEngine> engine_;  ///< none before the first node
};

}  // namespace placegraph
