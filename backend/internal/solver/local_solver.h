#pragma once
#include <placegraph/backend/internal/solver/local_solver_options.h>
#include <placegraph/backend/internal/solver/packed_graph.h>

#include <memory>

namespace placegraph {

/// Moves the poses of a packed graph down to a minimum of sum weight * rho(e^T Omega e) near them.
/// What follows from the pattern alone (ordering, symbolic analysis) is kept from one call to the
/// next, so that solving again with other weights, kernels or poses is cheap.
template <class Group>
class LocalSolver {
 public:
  explicit LocalSolver(const LocalSolverOptions& options);
  ~LocalSolver();

  /// Edges and held nodes must be those of the first call; poses, measurements and weights may
  /// differ.
  [[nodiscard]] LocalSolution solve(PackedGraph<Group>& graph);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// e^T Omega e of every edge, without kernel and weight, in the order of `graph.edges`.
template <class Group>
std::vector<double> chi2_by_edge(const PackedGraph<Group>& graph, RotationError rotation_error);
/// The same of every measured position.
template <class Group>
std::vector<double> chi2_by_position(const PackedGraph<Group>& graph);
/// Sum of weight * rho(e^T Omega e).
template <class Group>
double robust_cost(const PackedGraph<Group>& graph, RotationError rotation_error);

}  // namespace placegraph
