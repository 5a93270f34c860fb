#pragma once
#include <placegraph/backend/incremental/incremental_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

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

}  // namespace placegraph
