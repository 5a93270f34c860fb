#pragma once
#include <placegraph/backend/solver/local_solver.h>

namespace placegraph {

/// Increase of the cost of a solved graph, to first order, if an edge without weight were added.
/// It is e^T (Omega^-1 + Sigma)^-1 e with the edge's error e and the covariance Sigma of its
/// relative pose by the edges with weight. Unlike e^T Omega e it accounts for the stiffness of the
/// graph. One value per entry of `edges` (positions in graph.edges), at the graph's poses; empty if
/// the normal equations are singular.
///
/// Costs that are certainly above `enough` are approximations with estimates of Sigma (from samples
/// of the noise, after Spielman & Srivastava 2011); the others are exact.
template <class Group>
std::vector<double> cost_of_adding(const PackedGraph<Group>& graph, const std::vector<int>& edges,
                                   RotationError rotation_error, double enough);

}  // namespace placegraph
