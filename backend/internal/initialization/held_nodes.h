#pragma once
#include <placegraph/backend/internal/initialization/component_anchors.h>
#include <placegraph/backend/internal/initialization/isotropic_problem.h>

namespace placegraph {

/// The isotropic problem of the graph at the scales of its poses, the held nodes of a component
/// tied to each other, as they stand, by edges a thousand times as stiff as the heaviest one. With
/// all held nodes in place the ties cost nothing: a bound of this problem is one of the problem
/// with its nodes held.
template <class Group>
IsotropicProblem<kSpaceDim<Group>> held_node_constraints(const PackedGraph<Group>& graph,
                                                         const ComponentAnchors& anchors,
                                                         RotationError rotation_error);

}  // namespace placegraph
