#include <placegraph/backend/internal/robust/loop_pairs.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>
#include <tuple>

namespace placegraph {
namespace {

template <class Group>
LoopOnChain<Group> loop_on_chain(const PackedGraph<Group>& graph, int edge,
                                 const OdometryChain<Group>& chain) {
  const auto& e = graph.edges[edge];
  LoopOnChain<Group> loop{edge, e.from, e.to, {}, {}, {}};
  const Group T_first_measured = chain.pose(e.from) * e.T_to_from.inverse();
  loop.W = T_first_measured * chain.pose(e.to).inverse();
  const typename Group::Jacobian adjoint = T_first_measured.adjoint();
  loop.covariance = adjoint * covariance_of(e.information) * adjoint.transpose();
  const auto place = [&](int node) { return std::pair(chain.run(node), chain.position(node)); };
  if (place(e.to) < place(e.from)) {
    std::swap(loop.from, loop.to);
    loop.W = loop.W.inverse();
    const typename Group::Jacobian back = loop.W.adjoint();
    loop.covariance = (back * loop.covariance * back.transpose()).eval();
  }
  loop.adjoint = loop.W.adjoint();
  return loop;
}

/// Loops by cells of `reach` x `reach` poses: neighbours are in the same or an adjacent cell.
/// Loops between the same two nodes are one entry, so that many of them cost no more than few.
template <class Group>
class EndCells {
 public:
  EndCells(const std::vector<LoopOnChain<Group>>& loops, const OdometryChain<Group>& chain,
           int reach)
      : loops_(loops), chain_(chain), reach_(reach) {
    std::map<std::pair<int, int>, int> entry_of;
    for (std::size_t i = 0; i < loops.size(); ++i) {
      const auto [known, fresh] =
          entry_of.try_emplace({loops[i].from, loops[i].to}, static_cast<int>(entries_.size()));
      if (fresh) {
        cells_[cell_of(loops[i], 0, 0)].push_back(known->second);
        entries_.emplace_back();
      }
      entries_[static_cast<std::size_t>(known->second)].push_back(static_cast<int>(i));
    }
  }

  /// Candidates for the `neighbours` nearest loops of loop `i`: distance and loop.
  void near(int i, int neighbours, std::vector<std::pair<int, int>>& found) const {
    found.clear();
    const auto& loop = loops_[static_cast<std::size_t>(i)];
    for (int di = -1; di <= 1; ++di)
      for (int dj = -1; dj <= 1; ++dj) {
        const auto cell = cells_.find(cell_of(loop, di, dj));
        if (cell == cells_.end()) continue;
        for (const int entry : cell->second)
          add(i, loop, entries_[static_cast<std::size_t>(entry)], neighbours, found);
      }
  }

 private:
  using Cell = std::tuple<int, int, int, int>;
  Cell cell_of(const LoopOnChain<Group>& loop, int di, int dj) const {
    return {chain_.run(loop.from), chain_.run(loop.to), chain_.position(loop.from) / reach_ + di,
            chain_.position(loop.to) / reach_ + dj};
  }
  /// The first of the loops between two nodes, as many as can be among the nearest.
  void add(int i, const LoopOnChain<Group>& loop, const std::vector<int>& others, int neighbours,
           std::vector<std::pair<int, int>>& found) const {
    const auto& first = loops_[static_cast<std::size_t>(others.front())];
    const int at_from = std::abs(chain_.position(loop.from) - chain_.position(first.from));
    const int at_to = std::abs(chain_.position(loop.to) - chain_.position(first.to));
    if (at_from > reach_ || at_to > reach_) return;
    int left = neighbours;
    for (std::size_t k = 0; k < others.size() && left > 0; ++k) {
      if (others[k] == i) continue;
      found.emplace_back(at_from + at_to, others[k]);
      --left;
    }
  }

  const std::vector<LoopOnChain<Group>>& loops_;
  const OdometryChain<Group>& chain_;
  int reach_;
  std::vector<std::vector<int>> entries_;  ///< loops between the same two nodes, ascending
  std::map<Cell, std::vector<int>> cells_;
};

}  // namespace

template <class Group>
std::vector<LoopOnChain<Group>> loops_on_chain(const PackedGraph<Group>& graph,
                                               const OdometryChain<Group>& chain) {
  std::vector<LoopOnChain<Group>> loops;
  for (std::size_t i = 0; i < graph.edges.size(); ++i)
    if (!graph.edges[i].odometry) loops.push_back(loop_on_chain(graph, static_cast<int>(i), chain));
  std::sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) {
    if (std::tie(a.from, a.to) != std::tie(b.from, b.to))
      return std::tie(a.from, a.to) < std::tie(b.from, b.to);
    const auto log_a = a.W.log(), log_b = b.W.log();
    return std::lexicographical_compare(log_a.begin(), log_a.end(), log_b.begin(), log_b.end());
  });
  return loops;
}

template <class Group>
bool is_copy(const LoopOnChain<Group>& a, const LoopOnChain<Group>& b) {
  return a.from == b.from && a.to == b.to && a.W.log() == b.W.log() && a.covariance == b.covariance;
}

template <class Group>
RingMisclosure ring_misclosure(const LoopOnChain<Group>& a, const LoopOnChain<Group>& b,
                               const OdometryChain<Group>& chain) {
  typename Group::Jacobian covariance =
      a.covariance + b.covariance + chain.covariance(a.from, b.from);
  covariance.noalias() += a.adjoint * chain.covariance(a.to, b.to) * a.adjoint.transpose();
  const Eigen::LLT<typename Group::Jacobian> factor(covariance);
  const typename Group::Tangent e = factor.matrixL().solve((a.W * b.W.inverse()).log());
  return {e.squaredNorm(), 2 * factor.matrixLLT().diagonal().array().log().sum()};
}

template <class Group>
RingMisclosure drift_misclosure(const LoopOnChain<Group>& loop, const OdometryChain<Group>& chain) {
  const typename Group::Jacobian covariance =
      loop.covariance + chain.covariance(loop.from, loop.to);
  const typename Group::Tangent e = loop.W.log();
  const Eigen::LLT<typename Group::Jacobian> factor(covariance);
  return {e.dot(factor.solve(e)), 2 * factor.matrixLLT().diagonal().array().log().sum()};
}

template <class Group>
std::vector<LoopPair> neighbouring_pairs(const std::vector<LoopOnChain<Group>>& loops,
                                         const OdometryChain<Group>& chain, int reach,
                                         int neighbours) {
  const EndCells<Group> cells(loops, chain, reach);
  std::vector<std::pair<int, int>> pairs;
  std::vector<std::pair<int, int>> near;  // distance, loop
  for (std::size_t i = 0; i < loops.size(); ++i) {
    cells.near(static_cast<int>(i), neighbours, near);
    const std::size_t n = std::min(near.size(), static_cast<std::size_t>(neighbours));
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(n), near.end());
    for (std::size_t k = 0; k < n; ++k)
      pairs.emplace_back(std::minmax(static_cast<int>(i), near[k].second));
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<LoopPair> result;
  result.reserve(pairs.size());
  for (const auto& [a, b] : pairs)
    result.push_back({a, b, ring_misclosure(loops[a], loops[b], chain)});
  return result;
}

#define PLACEGRAPH_INSTANTIATE(Group)                                                           \
  template std::vector<LoopOnChain<Group>> loops_on_chain(const PackedGraph<Group>&,            \
                                                          const OdometryChain<Group>&);         \
  template bool is_copy(const LoopOnChain<Group>&, const LoopOnChain<Group>&);                  \
  template RingMisclosure ring_misclosure(const LoopOnChain<Group>&, const LoopOnChain<Group>&, \
                                          const OdometryChain<Group>&);                         \
  template RingMisclosure drift_misclosure(const LoopOnChain<Group>&,                           \
                                           const OdometryChain<Group>&);                        \
  template std::vector<LoopPair> neighbouring_pairs(const std::vector<LoopOnChain<Group>>&,     \
                                                    const OdometryChain<Group>&, int, int);
PLACEGRAPH_INSTANTIATE(SE2)
PLACEGRAPH_INSTANTIATE(SE3)
PLACEGRAPH_INSTANTIATE(Sim3)
#undef PLACEGRAPH_INSTANTIATE

}  // namespace placegraph
