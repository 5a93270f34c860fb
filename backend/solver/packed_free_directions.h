#pragma once
#include <placegraph/backend/solver/free_directions.h>
#include <placegraph/backend/solver/packed_graph.h>

namespace placegraph {

/// The same as find_free_directions of a PoseGraph, for a packed one.
template <class Group>
FreeDirections find_free_directions(const PackedGraph<Group>& graph, RotationError rotation_error);

}  // namespace placegraph
