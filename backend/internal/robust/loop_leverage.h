#pragma once
#include <placegraph/backend/internal/solver/local_solver.h>

namespace placegraph {

/// How much the cost of a solved graph would rise, to first order, if an edge that has no weight
/// were added: e^T (Omega^-1 + Sigma)^-1 e with the edge's error e and the covariance Sigma of its
/// relative pose as the edges with weight know it. What e^T Omega e alone cannot tell is whether
/// the graph is stiff there or free to give way. For every one of `edges` (positions in
/// graph.edges), at the graph's poses; empty if the normal equations are singular.
///
/// Costs that are surely above `enough` are told from estimates of Sigma alone (from samples of the
/// noise, after Spielman & Srivastava 2011) and are rough; the others are exact.
template <class Group>
std::vector<double> cost_of_adding(const PackedGraph<Group>& graph, const std::vector<int>& edges,
                                   RotationError rotation_error, double enough);

}  // namespace placegraph
