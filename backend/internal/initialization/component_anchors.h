#pragma once
#include <placegraph/backend/internal/solver/packed_graph.h>

namespace placegraph {

/// The anchors that tie the connected components of a graph to the world.
/// Components are connected by edges of nonzero weight.
struct ComponentAnchors {
  std::vector<int> component;  ///< component of every node, numbered from 0 in node order
  int components = 0;
  std::vector<int> roots;  ///< the first node of every component
  /// Held nodes, and the first node of every component without one: their poses determine the other
  /// poses.
  std::vector<char> anchor;
  /// Whether a component has no held node, but measured positions.
  std::vector<char> floating;
};

template <class Group>
ComponentAnchors find_anchors(const PackedGraph<Group>& graph);

}  // namespace placegraph
