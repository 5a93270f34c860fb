#pragma once
#include <placegraph/graph/pose_graph/constraint.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

struct LandmarkGraph;
struct PoseGraph;

/// Directions in which the cost of a graph does not change, up to rounding.
/// A minimum with such directions is not the only one.
struct FreeDirections {
  int count = 0;                    ///< number of directions; kMost means kMost or more
  std::vector<int> nodes;           ///< positions of the nodes that they move, ascending
  static constexpr int kMost = 64;  ///< maximum of `count`
};

/// The null space of the normal equations of the edges with weight.
/// Throws as PoseGraph::check. It is computed by subspace iteration on their shifted inverse;
/// curvatures below 1e-10 of the diagonal are regarded as zero. Without a null space the cost is
/// one factorization.
FreeDirections find_free_directions(const PoseGraph& graph, RotationError rotation_error);
/// The same for a landmark graph.
/// In `nodes` the numbers of its points follow those of its nodes. Throws as LandmarkGraph::check.
FreeDirections find_free_directions(const LandmarkGraph& graph, RotationError rotation_error);

}  // namespace placegraph
