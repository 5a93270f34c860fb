#pragma once
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <memory>
#include <optional>
#include <vector>

namespace placegraph {

struct IncrementalOptions {
  RotationError rotation_error = RotationError::kLog;
  /// Iterate until the cost is predicted to lie above the minimum by no more than this share
  /// (beginning somewhat earlier).
  double excess = 5e-3;
  double final_excess = 1e-8;  ///< the same of finish()
  /// An edge is linearized anew when its Jacobian has changed by this share of its norm.
  double relinearization = 0.2;
  int max_iterations = 20;  ///< of a step, before the whole graph is solved from scratch
  void check() const;
};
void visit(OptionVisitor& field, IncrementalOptions& options);

/// What one step did. `outcome` is kNotConverged if the cost lies further above its minimum than
/// was asked for, the poses being usable all the same; or if the normal equations cannot be
/// factorized at any damping, because a constraint is not finite or nearly so: nothing but nodes
/// newly joined has moved then, and steps succeed again once that constraint is removed.
struct IncrementalStep {
  Outcome outcome;
  int first_constraint = 0;  ///< number of the first constraint added; the others follow
  int iterations = 0;
  int nodes_moved = 0;         ///< of the last iteration
  int nodes_refactored = 0;    ///< eliminated anew, all iterations
  int edges_relinearized = 0;  ///< beside the new ones
  bool solved_from_scratch = false;
  double cost = 0;              ///< sum of weight * rho(e^T Omega e)
  double predicted_excess = 0;  ///< how far that lies above the minimum by the quadratic model
};

struct ConstraintWeight {
  int constraint = 0;  ///< its number, see IncrementalStep
  /// Of its cost, >= 0; 0 leaves it out as if it had never been there. It costs no time then and
  /// no memory but its record, and comes back with any other weight.
  double weight = 1;
};

/// A constraint as it is measured by now, between the nodes that it was given for.
struct ConstraintRevision {
  int constraint = 0;  ///< its number, see IncrementalStep
  Constraint measured;
};

/// All that one step may change.
struct GraphChange {
  std::vector<PoseNode> nodes;          ///< new ones
  std::vector<Constraint> constraints;  ///< new ones
  std::vector<ConstraintRevision> revised;
  std::vector<ConstraintWeight> weights;
};

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

  std::optional<PoseKind> kind() const;                  ///< none before the first node
  std::optional<Pose> pose(std::int64_t node_id) const;  ///< T_world_node; none if unknown
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
  Eigen::MatrixXd covariance(const std::vector<std::int64_t>& node_ids) const;

  /// Of T_from_to in its own right tangent. Throws ArgumentError for an unknown node and for nodes
  /// that nothing joins.
  Information relative_covariance(std::int64_t from, std::int64_t to) const;

  class Engine;

 private:
  IncrementalOptions options_;
  std::unique_ptr<Engine> engine_;  ///< none before the first node
};

}  // namespace placegraph
