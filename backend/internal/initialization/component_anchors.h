#pragma once
#include <placegraph/backend/internal/solver/packed_graph.h>

namespace placegraph {

/// What ties the connected components of a graph (over edges whose weight is not zero) to the
/// world.
struct ComponentAnchors {
  std::vector<int> component;  ///< of every node, numbered from 0 in node order
  int components = 0;
  std::vector<int> roots;  ///< the first node of every component
  /// Held nodes, and the first node of every component that has none: where they stand, the rest
  /// can be reckoned from.
  std::vector<char> anchor;
  /// Of every component: no held node, but measured positions.
  std::vector<char> floating;
};

template <class Group>
ComponentAnchors find_anchors(const PackedGraph<Group>& graph);

}  // namespace placegraph
