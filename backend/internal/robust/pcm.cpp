#include <placegraph/backend/internal/robust/max_clique.h>
#include <placegraph/backend/internal/robust/pcm.h>

#include <algorithm>
#include <map>

namespace placegraph {

namespace {

/// Loops that are copies of the first of them.
template <class Group>
using Copies = std::vector<LoopOnChain<Group>>;

template <class Group>
std::vector<int> consistent_of(const std::vector<Copies<Group>>& loops,
                               const OdometryChain<Group>& chain, double gate,
                               std::int64_t max_steps) {
  const int n = static_cast<int>(loops.size());
  BitGraph consistency(n);
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      if (ring_misclosure(loops[a].front(), loops[b].front(), chain).chi2 <= gate)
        consistency.join(a, b);
  std::vector<int> edges;
  for (const int i : max_clique(consistency, max_steps).vertices)
    for (const LoopOnChain<Group>& loop : loops[i]) edges.push_back(loop.edge);
  return edges;
}

}  // namespace

template <class Group>
std::vector<std::vector<int>> consistent_loops(const PackedGraph<Group>& graph,
                                               const OdometryChain<Group>& chain, double gate,
                                               std::int64_t max_steps) {
  std::map<std::pair<int, int>, std::vector<Copies<Group>>> by_runs;
  for (const LoopOnChain<Group>& loop : loops_on_chain(graph, chain)) {
    auto& loops = by_runs[{chain.run(loop.from), chain.run(loop.to)}];
    if (loops.empty() || !is_copy(loops.back().front(), loop)) loops.emplace_back();
    loops.back().push_back(loop);
  }
  std::vector<std::vector<int>> sets;
  for (const auto& [runs, loops] : by_runs)
    sets.push_back(consistent_of(loops, chain, gate, max_steps));
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
