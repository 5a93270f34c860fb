#pragma once
#include <vector>

namespace placegraph {

/// Which nodes of a growing graph hang together, and which are held: the fixed ones, and the first
/// node of a component that neither a fixed node nor a measured position ties to the world (its
/// anchors).
class IncrementalComponents {
 public:
  /// Returns the node's number, which counts from 0.
  int add_node(bool fixed);
  bool held(int node) const { return nodes_[node].held; }
  bool together(int a, int b) const { return nodes_[a].component == nodes_[b].component; }
  /// Makes one component of two. Returns the nodes of the one that should be moved to where the
  /// other says: the one without anchors, else the one whose first node came later; none if both
  /// have anchors.
  std::vector<int> join(int a, int b);
  /// Takes `part` of a component out of it.
  void split(const std::vector<int>& part);
  /// A measured position of the node came (+1) or went (-1).
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
    int held = -1;  ///< the node held for want of an anchor
  };
  void settle(Component& component);
  void set_held(int node, bool held);

  std::vector<Node> nodes_;
  std::vector<Component> components_;
  std::vector<int> free_components_;  ///< emptied by join()
  std::vector<int> changed_;
};

}  // namespace placegraph
