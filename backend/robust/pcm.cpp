#include <placegraph/backend/robust/max_clique.h>
#include <placegraph/backend/robust/pcm.h>
#include <placegraph/graph/core/parallel.h>

#include <algorithm>
#include <map>
#include <thread>

namespace placegraph {
namespace {

/// Loops between the same nodes with the same measurement and information.
template <class Group>
bool are_copies(const LoopOnChain<Group>& a, const LoopOnChain<Group>& b) {
  return a.from == b.from && a.to == b.to && a.W.log() == b.W.log() && a.covariance == b.covariance;
}

/// Positions of consecutive copies; copies agree with each other and with the same other loops.
template <class Group>
std::vector<std::vector<int>> groups_of_copies(const std::vector<LoopOnChain<Group>>& loops) {
  std::vector<std::vector<int>> groups;
  for (int i = 0; i < static_cast<int>(loops.size()); ++i) {
    if (groups.empty() || !are_copies(loops[groups.back().front()], loops[i]))
      groups.emplace_back();
    groups.back().push_back(i);
  }
  return groups;
}

/// Number of threads for comparing every pair of `loops`; the result does not depend on it.
int threads_for(int loops) {
  constexpr int kMany = 500;  // loops whose comparison takes longer than starting threads. Chosen.
  return loops < kMany ? 1 : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace

template <class Group>
std::vector<std::vector<int>> consistent_loops(const PackedGraph<Group>& graph,
                                               const OdometryChain<Group>& chain, double gate,
                                               std::int64_t max_steps) {
  std::map<std::pair<int, int>, std::vector<LoopOnChain<Group>>> by_runs;
  for (const LoopOnChain<Group>& loop : loops_on_chain(graph, chain))
    by_runs[{chain.run(loop.from), chain.run(loop.to)}].push_back(loop);
  std::vector<std::vector<int>> sets;
  for (const auto& [runs, loops] : by_runs) {
    const std::vector<std::vector<int>> groups = groups_of_copies(loops);
    const int n = static_cast<int>(groups.size());
    std::vector<int> weights;
    for (const auto& group : groups) weights.push_back(static_cast<int>(group.size()));
    BitGraph consistency(n);
    parallel_for(n, threads_for(n), [&](int a) {
      for (int b = a + 1; b < n; ++b)
        if (ring_closes(loops[groups[a].front()], loops[groups[b].front()], chain, gate))
          consistency.point(a, b);
    });
    consistency.mirror();
    sets.emplace_back();
    for (const int group : max_clique(consistency, max_steps, weights).vertices)
      for (const int i : groups[group]) sets.back().push_back(loops[i].edge);
  }
  std::stable_sort(sets.begin(), sets.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return sets;
}

template std::vector<std::vector<int>> consistent_loops(const PackedGraph<SE2>&,
                                                        const OdometryChain<SE2>&, double,
                                                        std::int64_t);
template std::vector<std::vector<int>> consistent_loops(const PackedGraph<SE3>&,
                                                        const OdometryChain<SE3>&, double,
                                                        std::int64_t);
template std::vector<std::vector<int>> consistent_loops(const PackedGraph<Sim3>&,
                                                        const OdometryChain<Sim3>&, double,
                                                        std::int64_t);

}  // namespace placegraph
