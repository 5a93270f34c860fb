#pragma once
#include <placegraph/backend/internal/solver/local_solver.h>
#include <placegraph/backend/pose_graph/pose_graph_options.h>
#include <placegraph/graph/core/options.h>

namespace placegraph {

struct GncSolution {
  LocalSolution local;  ///< of the last solve; iterations are those of all rounds
  int rounds = 0;
};

/// Graduated non-convexity (Yang et al. 2020, "Graduated non-convexity for robust spatial
/// perception", algorithm 1): minimizes sum of e^T Omega e over odometry plus a robust cost of the
/// other edges that begins convex and ends as truncated least squares, rho = min(s, gate), or as
/// Geman & McClure's. `graph.edges[i].weight` comes out as 1 or 0 (exactly so for both surrogates,
/// with s <= gate deciding in the end); odometry keeps the weight it came with, and
/// a loop that came without weight stays out.
///
/// The schedule comes from the residuals: with U = (mu + 1) / mu * gate, the squared error above
/// which an edge has no weight left, it begins at twice the largest squared error of the plain
/// minimum (their mu_0) and falls in each round by `least_factor` or as far as `share_per_round` of
/// the undecided edges allows, until no edge lies between weight 0 and 1.
///
/// `gate` is a squared error in the units of the information. Fails as LocalSolver does.
template <class Group>
[[nodiscard]] GncSolution graduated_non_convexity(PackedGraph<Group>& graph, double gate,
                                                  const LocalSolverOptions& solver,
                                                  const GncOptions& options);

}  // namespace placegraph
