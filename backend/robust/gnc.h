#pragma once
#include <placegraph/backend/robust/robust_options.h>
#include <placegraph/backend/solver/local_solver.h>
#include <placegraph/graph/core/options.h>

namespace placegraph {

struct GncSolution {
  LocalSolution local;  ///< result of the last solve; total iterations of all rounds
  int rounds = 0;
};

/// Graduated non-convexity (Yang et al. 2020, algorithm 1).
/// "Graduated non-convexity for robust spatial perception": it minimizes the sum of e^T Omega e
/// over odometry plus a robust cost of the other edges, which starts convex and ends as truncated
/// least squares, rho = min(s, gate), or as the cost of Geman & McClure. On return
/// `graph.edges[i].weight` is 1 or 0 (exactly, for both surrogates; the final criterion is s <=
/// gate). Odometry keeps its weight, and a loop without weight stays excluded.
///
/// The schedule comes from the residuals: with U = (mu + 1) / mu * gate, the squared error above
/// which an edge has no weight left, it starts at twice the largest squared error of the plain
/// minimum (mu_0 of the paper). Each round divides it by `least_factor`, or by more as
/// `share_per_round` of the undecided edges allows, until no weight is between 0 and 1.
///
/// `gate` is a squared error weighted by the information. Outcomes as LocalSolver.
template <class Group>
[[nodiscard]] GncSolution graduated_non_convexity(PackedGraph<Group>& graph, double gate,
                                                  const LocalSolverOptions& solver,
                                                  const GncOptions& options);

}  // namespace placegraph
