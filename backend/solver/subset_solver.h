#pragma once
#include <placegraph/backend/solver/local_solver.h>

namespace placegraph {

/// LocalSolver on the edges that have weight.
/// Edges without weight in the pattern of the normal equations cost fill-in, a new pattern costs an
/// analysis: the pattern is kept while most of its edges have weight.
template <class Group>
class SubsetSolver {
 public:
  explicit SubsetSolver(const LocalSolverOptions& options) : options_(options) {}

  /// Moves the poses of `graph` to a minimum near them. The edges with weight must connect every
  /// node to a held node.
  [[nodiscard]] LocalSolution solve(PackedGraph<Group>& graph);

 private:
  bool fits(const PackedGraph<Group>& graph) const;
  void take_pattern(const PackedGraph<Group>& graph);

  LocalSolverOptions options_;
  std::unique_ptr<LocalSolver<Group>> solver_;
  PackedGraph<Group> subset_;
  std::vector<int> edges_;  ///< edges of the subset, as positions in the whole graph's edges
};

}  // namespace placegraph
