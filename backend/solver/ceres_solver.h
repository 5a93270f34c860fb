#pragma once
#include <placegraph/backend/solver/local_solver_options.h>
#include <placegraph/backend/solver/packed_graph.h>

namespace placegraph {

/// The engine `ceres`: Levenberg-Marquardt with analytic cost functions and a sparse Cholesky
/// factorization (SuiteSparse's; Eigen's without the GPL parts).
template <class Group>
LocalSolution solve_with_ceres(PackedGraph<Group>& graph, const LocalSolverOptions& options);

}  // namespace placegraph
