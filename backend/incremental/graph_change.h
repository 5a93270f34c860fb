#pragma once
#include <placegraph/backend/incremental/incremental_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Report of one step of the incremental optimizer.
/// `outcome` is kNotConverged if the cost exceeds its minimum by more than was requested; the poses
/// can still be used. It is also kNotConverged if the normal equations cannot be factorized with
/// any damping, because a constraint has numbers that are infinite, NaN or very large: then only
/// newly connected nodes have moved, and steps succeed again once that constraint is removed.
struct IncrementalStep {
  Outcome outcome;                   ///< ok, or kNotConverged
  int first_constraint = 0;          ///< number of the first added constraint; the others follow
  int iterations = 0;                ///< number of Gauss-Newton iterations
  int nodes_moved = 0;               ///< nodes that the last iteration moved
  int nodes_refactored = 0;          ///< nodes eliminated again, in all iterations
  int edges_relinearized = 0;        ///< edges linearized again, without the new ones
  bool solved_from_scratch = false;  ///< whether the whole graph was optimized at once
  double cost = 0;                   ///< sum of weight * rho(e^T Omega e)
  double predicted_excess = 0;       ///< cost minus its minimum, by the quadratic model
};

/// A new weight of a constraint.
struct ConstraintWeight {
  int constraint = 0;  ///< its number, see IncrementalStep
  /// Factor of its cost, >= 0. With 0 the constraint has no effect and costs no time and little
  /// memory. Any other weight restores it.
  double weight = 1;
};

/// A new measurement of a constraint, which must join the same nodes as before.
struct ConstraintRevision {
  int constraint = 0;   ///< its number, see IncrementalStep
  Constraint measured;  ///< new measurement
};

/// The changes of one step.
struct GraphChange {
  std::vector<PoseNode> nodes;              ///< new nodes
  std::vector<Constraint> constraints;      ///< new constraints
  std::vector<ConstraintRevision> revised;  ///< constraints with a new measurement
  std::vector<ConstraintWeight> weights;    ///< constraints with a new weight
};

}  // namespace placegraph
