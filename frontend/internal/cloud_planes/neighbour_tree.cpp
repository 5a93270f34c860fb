#include <placegraph/frontend/internal/cloud_planes/neighbour_tree.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace placegraph {

struct NeighbourTree::Search {
  int self = 0;
  std::size_t k = 0;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  std::vector<std::pair<double, int>> best;  ///< squared distance, point; ascending
};

NeighbourTree::NeighbourTree(const std::vector<Eigen::Vector3d>& points)
    : points_(&points), order_(points.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(points.size() / 4 + 1);
  if (!points.empty()) build(0, static_cast<int>(points.size()));
}

int NeighbourTree::build(int begin, int end) {
  constexpr int kLeaf = 10;
  const int index = static_cast<int>(nodes_.size());
  nodes_.push_back({begin, end});
  if (end - begin <= kLeaf) return index;
  Eigen::Vector3d least = (*points_)[static_cast<std::size_t>(order_[begin])], most = least;
  for (int i = begin; i < end; ++i) {
    const Eigen::Vector3d& p = (*points_)[static_cast<std::size_t>(order_[i])];
    least = least.cwiseMin(p), most = most.cwiseMax(p);
  }
  int axis = 0;
  if (!((most - least).maxCoeff(&axis) > 0)) return index;  // all at one position
  const int middle = begin + (end - begin) / 2;
  const auto key = [&](int i) { return (*points_)[static_cast<std::size_t>(i)][axis]; };
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int a, int b) { return key(a) < key(b) || (key(a) == key(b) && a < b); });
  const double cut = key(order_[middle]);
  const int first = build(begin, middle), second = build(middle, end);
  Node& node = nodes_[static_cast<std::size_t>(index)];
  node.axis = axis, node.cut = cut, node.first = first, node.second = second;
  return index;
}

void NeighbourTree::nearest(int i, int k, std::vector<int>& found) const {
  Search search{i, static_cast<std::size_t>(k), (*points_)[static_cast<std::size_t>(i)], {}};
  search.best.reserve(search.k + 1);
  if (k > 0) visit(0, search);
  found.clear();
  for (const auto& [distance, index] : search.best) found.push_back(index);
}

void NeighbourTree::visit(int index, Search& search) const {
  const Node& node = nodes_[static_cast<std::size_t>(index)];
  if (node.axis < 0) {
    for (int i = node.begin; i < node.end; ++i) {
      const int point = order_[static_cast<std::size_t>(i)];
      if (point == search.self) continue;
      const std::pair<double, int> entry{
          ((*points_)[static_cast<std::size_t>(point)] - search.at).squaredNorm(), point};
      if (search.best.size() == search.k && !(entry < search.best.back())) continue;
      if (search.best.size() == search.k) search.best.pop_back();
      search.best.insert(std::upper_bound(search.best.begin(), search.best.end(), entry), entry);
    }
    return;
  }
  const double beyond = search.at[node.axis] - node.cut;
  visit(beyond < 0 ? node.first : node.second, search);
  if (search.best.size() < search.k || beyond * beyond <= search.best.back().first)
    visit(beyond < 0 ? node.second : node.first, search);
}

}  // namespace placegraph
