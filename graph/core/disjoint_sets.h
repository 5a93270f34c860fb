#pragma once
#include <numeric>
#include <utility>
#include <vector>

namespace placegraph {

/// Disjoint sets of the numbers 0..n-1 that can only be joined (Tarjan 1975, with path halving).
/// The lowest member is the root of its set.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int i, int j) {
    i = root(i), j = root(j);
    if (i > j) std::swap(i, j);
    parent_[j] = i;
  }
  /// For every member the number of its set; sets are counted from 0 in the order of their roots.
  std::vector<int> numbers() {
    std::vector<int> number(parent_.size());
    int count = 0;
    for (int i = 0; i < static_cast<int>(parent_.size()); ++i)
      number[i] = root(i) == i ? count++ : number[root(i)];
    return number;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace placegraph
