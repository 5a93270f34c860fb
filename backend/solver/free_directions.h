#pragma once
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/solver/packed_graph.h>

namespace placegraph {

/// Directions in which the cost of a graph does not change, to rounding, from where its poses are:
/// a minimum there is not the only one.
struct FreeDirections {
  int count = 0;           ///< kMost stands for as many or more
  std::vector<int> nodes;  ///< positions of the nodes that move along them, ascending
  static constexpr int kMost = 64;
};

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
