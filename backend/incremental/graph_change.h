#pragma once
#include <placegraph/backend/incremental/incremental_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What one step of the incremental optimizer did.
/// `outcome` is kNotConverged if the cost is further above its minimum than was asked for; the
/// poses are usable all the same. It is kNotConverged too if the normal equations cannot be
/// factorized at any damping, because a constraint is not finite or nearly so: then only newly
/// joined nodes have moved, and steps succeed again once that constraint is removed.
struct IncrementalStep {
  Outcome outcome;                   ///< ok, or kNotConverged
  int first_constraint = 0;          ///< number of the first constraint added; the others follow
  int iterations = 0;                ///< Gauss-Newton iterations
  int nodes_moved = 0;               ///< in the last iteration
  int nodes_refactored = 0;          ///< eliminated again, in all iterations
  int edges_relinearized = 0;        ///< in addition to the new ones
  bool solved_from_scratch = false;  ///< whether the whole graph was optimized at once
  double cost = 0;                   ///< sum of weight * rho(e^T Omega e)
  double predicted_excess = 0;       ///< cost above its minimum by the quadratic model
};

/// A new weight of a constraint.
struct ConstraintWeight {
  int constraint = 0;  ///< its number, see IncrementalStep
  /// Factor of its cost, >= 0. With 0 the constraint is left out as if it had never been there: it
  /// costs no time and little memory. Any other weight brings it back.
  double weight = 1;
};

/// A new measurement of a constraint, which must join the same nodes as before.
struct ConstraintRevision {
  int constraint = 0;   ///< its number, see IncrementalStep
  Constraint measured;  ///< replaces the former one
};

/// All that one step may change.
struct GraphChange {
  std::vector<PoseNode> nodes;              ///< new ones
  std::vector<Constraint> constraints;      ///< new ones
  std::vector<ConstraintRevision> revised;  ///< constraints with a new measurement
  std::vector<ConstraintWeight> weights;    ///< constraints with a new weight
};

}  // namespace placegraph
