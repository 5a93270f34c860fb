#pragma once
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

struct LandmarkGraph;
struct PoseGraph;

/// The connected components of a graph, and what ties each of them to the world.
///
/// Nodes are connected by edges that have weight and by observations of points.
struct GraphComponents {
  std::vector<int> component;  ///< component of every node, numbered from 0 in node order
  std::vector<int> first;      ///< the first node of every component
  /// Held nodes: the fixed ones, and the first node of every component without a fixed node or a
  /// measured position.
  std::vector<char> held;
  /// Held nodes, and the first node of every floating component: their poses determine the other
  /// poses by the edges.
  std::vector<char> anchor;
  /// Whether a component has no held node, but measured positions.
  std::vector<char> floating;
  /// Edges and observations beyond those that determine the nodes from the anchors; never negative.
  int redundant = 0;
  /// Expected sum of e^T Omega e at the minimum: the dimension of all errors without that of the
  /// nodes. Measured positions count in a floating component beyond those that place it.
  int degrees_of_freedom = 0;

  int count() const { return static_cast<int>(first.size()); }
};

/// The components of a pose graph, which must have passed PoseGraph::check.
GraphComponents find_components(const PoseGraph& graph);
/// The same of a landmark graph: of its nodes, then its points, and last the world.
GraphComponents find_components(const LandmarkGraph& graph);

}  // namespace placegraph
