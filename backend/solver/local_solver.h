#pragma once
#include <placegraph/backend/solver/local_solver_options.h>
#include <placegraph/backend/solver/packed_graph.h>

#include <memory>

namespace placegraph {

/// Moves the poses of a packed graph to a nearby minimum of sum weight * rho(e^T Omega e).
/// Ordering and symbolic analysis, which depend only on the pattern, are kept between calls, so
/// that further solutions with other weights, kernels or poses are cheap.
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
/// The same for every measured position.
template <class Group>
std::vector<double> chi2_by_position(const PackedGraph<Group>& graph);
/// Sum of weight * rho(e^T Omega e).
template <class Group>
double robust_cost(const PackedGraph<Group>& graph, RotationError rotation_error);

}  // namespace placegraph
