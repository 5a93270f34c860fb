#pragma once
#include <Eigen/Core>
#include <vector>

namespace placegraph {

/// A k-d tree over points that stay where they are (Bentley 1975): cuts at the median of the widest
/// side down to small leaves.
class NeighbourTree {
 public:
  /// Keeps a reference to `points`.
  explicit NeighbourTree(const std::vector<Eigen::Vector3d>& points);

  /// The `k` points nearest to point `i` without itself, the nearest first; fewer where there are
  /// fewer. `found` is resized.
  void nearest(int i, int k, std::vector<int>& found) const;

 private:
  struct Node {
    int begin = 0, end = 0;  ///< in order_
    int axis = -1;           ///< -1: a leaf
    double cut = 0;          ///< below: first child
    int first = -1, second = -1;
  };
  struct Search;
  int build(int begin, int end);
  void visit(int node, Search& search) const;

  const std::vector<Eigen::Vector3d>* points_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace placegraph
