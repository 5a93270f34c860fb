#pragma once
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/internal/solver/packed_graph.h>
#include <placegraph/backend/pose_graph/pose_graph_report.h>

namespace placegraph {

/// The null space of the normal equations of the edges with weight, by subspace iteration on their
/// shifted inverse: what is below 1e-10 of the diagonal counts as nothing. Costs one factorization
/// where there is none.
template <class Group>
FreeDirections find_free_directions(const PackedGraph<Group>& graph, RotationError rotation_error);
/// The same of a pose graph. Throws as PoseGraph::check.
FreeDirections find_free_directions(const PoseGraph& graph, RotationError rotation_error);
/// The same of a landmark graph; `nodes` counts its points on behind its nodes. Throws as
/// LandmarkGraph::check.
FreeDirections find_free_directions(const LandmarkGraph& graph, RotationError rotation_error);

}  // namespace placegraph
