#pragma once
#include <vector>

namespace placegraph {

/// The connected components of an incremental graph, and its held nodes.
/// Held are the fixed nodes, and the first node of a component without anchors, i.e. without a
/// fixed node or a measured position.
class IncrementalComponents {
 public:
  /// Adds a node and returns its number, starting from 0.
  int add_node(bool fixed);
  bool held(int node) const { return nodes_[node].held; }
  bool together(int a, int b) const { return nodes_[a].component == nodes_[b].component; }
  /// Joins two components. Returns the nodes of the component that should be moved to fit the
  /// other: the one without anchors, else the one whose first node was added later; empty if both
  /// have anchors.
  std::vector<int> join(int a, int b);
  /// Makes components of pieces: of each component that falls apart all pieces, or all but one.
  void split(const std::vector<std::vector<int>>& pieces);
  /// A measured position of the node was added (+1) or removed (-1).
  void anchor(int node, int count);
  /// Nodes whose held() has changed since the last call.
  std::vector<int> take_changed();

 private:
  struct Node {
    int component;
    bool fixed, held;
    int positions = 0;
  };
  struct Component {
    std::vector<int> nodes;
    int first;
    int anchors = 0;
    int held = -1;  ///< the node held in the absence of an anchor
  };
  int add_component(const std::vector<int>& nodes);
  void count(Component& component);
  void settle(Component& component);
  void set_held(int node, bool held);

  std::vector<Node> nodes_;
  std::vector<Component> components_;
  std::vector<int> free_components_;  ///< unused components, emptied by join()
  std::vector<int> changed_;
};

}  // namespace placegraph
