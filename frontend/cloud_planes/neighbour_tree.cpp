#include <placegraph/frontend/cloud_planes/neighbour_tree.h>

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace placegraph {

struct NeighbourTree::Search {
  int self = 0;
  std::size_t k = 0;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  std::vector<std::pair<double, int>> best;  ///< squared distance, point; ascending
};

NeighbourTree::NeighbourTree(const std::vector<Eigen::Vector3d>& points)
    : points_(&points), order_(points.size()), rank_(points.size()) {
  group_equal_points();
  nodes_.reserve(positions_.size() / 4 + 1);
  if (!positions_.empty()) build(0, static_cast<int>(positions_.size()));
}

void NeighbourTree::group_equal_points() {
  const auto at = [&](int i) -> const Eigen::Vector3d& {
    return (*points_)[static_cast<std::size_t>(i)];
  };
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](int a, int b) {
    const Eigen::Vector3d &p = at(a), &q = at(b);
    return std::tie(p[0], p[1], p[2], a) < std::tie(q[0], q[1], q[2], b);
  });
  for (int k = 0; k < static_cast<int>(order_.size()); ++k) {
    const int point = order_[static_cast<std::size_t>(k)];
    rank_[static_cast<std::size_t>(point)] = k;
    if (positions_.empty() || at(positions_.back().first) != at(point))
      positions_.push_back({k, k, point});
    positions_.back().end = k + 1;
  }
}

int NeighbourTree::build(int begin, int end) {
  constexpr int kLeaf = 10;
  const int index = static_cast<int>(nodes_.size());
  nodes_.push_back({begin, end});
  if (end - begin <= kLeaf) return index;
  const auto at = [&](const Position& position) -> const Eigen::Vector3d& {
    return (*points_)[static_cast<std::size_t>(position.first)];
  };
  const auto from = positions_.begin() + begin, to = positions_.begin() + end;
  Eigen::Vector3d least = at(*from), most = least;
  for (auto position = from; position != to; ++position)
    least = least.cwiseMin(at(*position)), most = most.cwiseMax(at(*position));
  int axis = 0;
  (most - least).maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  const auto key = [&](const Position& position) {
    return std::pair(at(position)[axis], position.first);
  };
  std::nth_element(from, positions_.begin() + middle, to,
                   [&](const Position& a, const Position& b) { return key(a) < key(b); });
  const double cut = key(positions_[static_cast<std::size_t>(middle)]).first;
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

void NeighbourTree::offer(const Position& position, Search& search) const {
  const double distance =
      ((*points_)[static_cast<std::size_t>(position.first)] - search.at).squaredNorm();
  const int own = rank_[static_cast<std::size_t>(search.self)];
  const int size = position.end - position.begin;
  const bool around_self = own >= position.begin && own < position.end;
  // From the point behind its own one on, and around.
  const int skip = around_self ? own - position.begin + 1 : 0;
  const int count = std::min(static_cast<int>(search.k), around_self ? size - 1 : size);
  for (int i = 0; i < count; ++i) {
    const int k = position.begin + (skip + i) % size;
    const std::pair<double, int> entry{distance, order_[static_cast<std::size_t>(k)]};
    if (search.best.size() == search.k && !(entry < search.best.back())) continue;
    if (search.best.size() == search.k) search.best.pop_back();
    search.best.insert(std::upper_bound(search.best.begin(), search.best.end(), entry), entry);
  }
}

void NeighbourTree::visit(int index, Search& search) const {
  const Node& node = nodes_[static_cast<std::size_t>(index)];
  if (node.axis < 0) {
    for (int i = node.begin; i < node.end; ++i)
      offer(positions_[static_cast<std::size_t>(i)], search);
    return;
  }
  const double beyond = search.at[node.axis] - node.cut;
  visit(beyond < 0 ? node.first : node.second, search);
  if (search.best.size() < search.k || beyond * beyond <= search.best.back().first)
    visit(beyond < 0 ? node.second : node.first, search);
}

}  // namespace placegraph
