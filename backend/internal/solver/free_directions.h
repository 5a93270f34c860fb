#pragma once
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/internal/solver/packed_graph.h>
#include <placegraph/backend/pose_graph/pose_graph_report.h>

namespace placegraph {

/// The null space of the normal equations of the edges with weight.
/// It is computed by subspace iteration on their shifted inverse; curvatures below 1e-10 of the
/// diagonal are regarded as zero. Without a null space the cost is one factorization.
template <class Group>
FreeDirections find_free_directions(const PackedGraph<Group>& graph, RotationError rotation_error);
/// The same for a pose graph. Throws as PoseGraph::check.
FreeDirections find_free_directions(const PoseGraph& graph, RotationError rotation_error);
/// The same for a landmark graph; in `nodes` the numbers of its points follow those of its nodes.
/// Throws as LandmarkGraph::check.
FreeDirections find_free_directions(const LandmarkGraph& graph, RotationError rotation_error);

}  // namespace placegraph
