#include <placegraph/backend/robust/loop_pairs.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
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
  if (chain.place(e.to) < chain.place(e.from)) {
    std::swap(loop.from, loop.to);
    loop.W = loop.W.inverse();
    const typename Group::Jacobian back = loop.W.adjoint();
    loop.covariance = (back * loop.covariance * back.transpose()).eval();
  }
  loop.adjoint = loop.W.adjoint();
  return loop;
}

}  // namespace

template <class Group>
std::vector<LoopOnChain<Group>> loops_on_chain(const PackedGraph<Group>& graph,
                                               const OdometryChain<Group>& chain) {
  std::vector<LoopOnChain<Group>> loops;
  for (std::size_t i = 0; i < graph.edges.size(); ++i)
    if (!graph.edges[i].odometry) loops.push_back(loop_on_chain(graph, static_cast<int>(i), chain));
  const auto ends = [&](const LoopOnChain<Group>& loop) {
    return std::pair(chain.place(loop.from), chain.place(loop.to));
  };
  std::sort(loops.begin(), loops.end(), [&](const auto& a, const auto& b) {
    if (ends(a) != ends(b)) return ends(a) < ends(b);
    const auto log_a = a.W.log(), log_b = b.W.log();
    return std::lexicographical_compare(log_a.begin(), log_a.end(), log_b.begin(), log_b.end());
  });
  return loops;
}

namespace {

/// The covariance of the misclosure of the ring of two loops.
template <class Group>
typename Group::Jacobian ring_covariance(const LoopOnChain<Group>& a, const LoopOnChain<Group>& b,
                                         const OdometryChain<Group>& chain) {
  typename Group::Jacobian covariance =
      a.covariance + b.covariance + chain.covariance(a.from, b.from);
  covariance.noalias() += a.adjoint * chain.covariance(a.to, b.to) * a.adjoint.transpose();
  return covariance;
}

template <class Group>
typename Group::Tangent log_of(const Group& T) {
  return T.log();
}

/// The logarithm by the tangent of half the angle, to rounding: atan2, sin and cos would take most
/// of the time of a pair of loops in the plane.
SE2::Tangent log_of(const SE2& T) {
  const Eigen::Vector2d x_axis = T.rotation() * Eigen::Vector2d::UnitX();
  if (x_axis[0] < 0) return T.log();
  const double tan_h = x_axis[1] / (1 + x_axis[0]), x = tan_h * tan_h;
  double h_cot_h = 0;  // atan(tan_h) / tan_h
  if (x < 0.01)
    for (const double term :
         {1. / 17, 1. / 15, 1. / 13, 1. / 11, 1. / 9, 1. / 7, 1. / 5, 1. / 3, 1.})
      h_cot_h = term - x * h_cot_h;
  else
    h_cot_h = std::atan(tan_h) / tan_h;
  const double h = h_cot_h * tan_h;
  const Eigen::Vector2d& t = T.translation();
  return {h_cot_h * t[0] + h * t[1], h_cot_h * t[1] - h * t[0], 2 * h};
}

}  // namespace

template <class Group>
bool ring_closes(const LoopOnChain<Group>& a, const LoopOnChain<Group>& b,
                 const OdometryChain<Group>& chain, double gate) {
  constexpr int kDof = Group::kDof;
  typename Group::Jacobian L = ring_covariance(a, b, chain);
  typename Group::Tangent e = log_of(a.W * b.W.inverse());
  // L D L^T row by row, 1 / D on the diagonal, with forward substitution: the sum only grows.
  double chi2 = 0;
  for (int i = 0; i < kDof; ++i) {
    for (int k = 0; k < i; ++k) {
      double value = L(i, k);
      for (int j = 0; j < k; ++j) value -= L(i, j) * L(j, k);
      L(k, i) = value;  // L D
      L(i, k) = value * L(k, k);
      L(i, i) -= L(i, k) * value;
      e[i] -= L(i, k) * e[k];
    }
    L(i, i) = 1 / L(i, i);
    chi2 += e[i] * e[i] * L(i, i);
    if (!(chi2 <= gate)) return false;
  }
  return true;
}

template <class Group>
RingMisclosure ring_misclosure(const LoopOnChain<Group>& a, const LoopOnChain<Group>& b,
                               const OdometryChain<Group>& chain) {
  const typename Group::Jacobian covariance = ring_covariance(a, b, chain);
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
  // Loops by cells of `reach` x `reach` poses: neighbours are in the same or an adjacent cell.
  // Those between the same two nodes are equally near: of them the first ones suffice, however
  // many.
  using Cell = std::tuple<int, int, int, int>;
  const auto cell_of = [&](const LoopOnChain<Group>& loop, int di, int dj) {
    return Cell{chain.run(loop.from), chain.run(loop.to), chain.position(loop.from) / reach + di,
                chain.position(loop.to) / reach + dj};
  };
  struct SameEnds {
    int first, count;  // positions in `loops`, which are sorted by their ends
  };
  std::map<Cell, std::vector<SameEnds>> cells;
  for (int i = 0; i < static_cast<int>(loops.size()); ++i) {
    std::vector<SameEnds>& cell = cells[cell_of(loops[i], 0, 0)];
    if (!cell.empty() && loops[cell.back().first].from == loops[i].from &&
        loops[cell.back().first].to == loops[i].to)
      ++cell.back().count;
    else
      cell.push_back({i, 1});
  }

  std::vector<std::pair<int, int>> pairs;
  std::vector<std::pair<int, int>> near;  // distance, loop
  for (int i = 0; i < static_cast<int>(loops.size()); ++i) {
    near.clear();
    for (int di = -1; di <= 1; ++di)
      for (int dj = -1; dj <= 1; ++dj) {
        const auto cell = cells.find(cell_of(loops[i], di, dj));
        if (cell == cells.end()) continue;
        for (const SameEnds& others : cell->second) {
          const LoopOnChain<Group>& other = loops[others.first];
          const int at_from = std::abs(chain.position(loops[i].from) - chain.position(other.from));
          const int at_to = std::abs(chain.position(loops[i].to) - chain.position(other.to));
          if (at_from > reach || at_to > reach) continue;
          const int end = others.first + std::min(others.count, neighbours + 1);
          for (int k = others.first; k < end; ++k)
            if (k != i) near.emplace_back(at_from + at_to, k);
        }
      }
    const std::size_t n = std::min(near.size(), static_cast<std::size_t>(neighbours));
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(n), near.end());
    for (std::size_t k = 0; k < n; ++k) pairs.emplace_back(std::minmax(i, near[k].second));
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
  template RingMisclosure ring_misclosure(const LoopOnChain<Group>&, const LoopOnChain<Group>&, \
                                          const OdometryChain<Group>&);                         \
  template bool ring_closes(const LoopOnChain<Group>&, const LoopOnChain<Group>&,               \
                            const OdometryChain<Group>&, double);                               \
  template RingMisclosure drift_misclosure(const LoopOnChain<Group>&,                           \
                                           const OdometryChain<Group>&);                        \
  template std::vector<LoopPair> neighbouring_pairs(const std::vector<LoopOnChain<Group>>&,     \
                                                    const OdometryChain<Group>&, int, int);
PLACEGRAPH_INSTANTIATE(SE2)
PLACEGRAPH_INSTANTIATE(SE3)
PLACEGRAPH_INSTANTIATE(Sim3)
#undef PLACEGRAPH_INSTANTIATE

}  // namespace placegraph
