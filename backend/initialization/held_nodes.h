#pragma once
#include <placegraph/backend/initialization/isotropic_problem.h>

namespace placegraph {

/// The isotropic problem of the graph at the scales of its poses, with ties between held nodes.
/// The held nodes of a component are connected to each other, at their current poses, by edges a
/// thousand times as stiff as the heaviest edge. With all held nodes in place the ties have zero
/// cost, so a bound of this problem is also one of the problem with its nodes held.
template <class Group>
IsotropicProblem<kSpaceDim<Group>> held_node_constraints(const PackedGraph<Group>& graph,
                                                         RotationError rotation_error);

}  // namespace placegraph
