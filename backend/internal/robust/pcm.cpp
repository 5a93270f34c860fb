#include <placegraph/backend/internal/robust/max_clique.h>
#include <placegraph/backend/internal/robust/pcm.h>

#include <algorithm>
#include <map>

namespace placegraph {

template <class Group>
std::vector<std::vector<int>> consistent_loops(const PackedGraph<Group>& graph,
                                               const OdometryChain<Group>& chain, double gate,
                                               std::int64_t max_steps) {
  std::map<std::pair<int, int>, std::vector<LoopOnChain<Group>>> by_runs;
  for (const LoopOnChain<Group>& loop : loops_on_chain(graph, chain))
    by_runs[{chain.run(loop.from), chain.run(loop.to)}].push_back(loop);
  std::vector<std::vector<int>> sets;
  for (const auto& [runs, loops] : by_runs) {
    const int n = static_cast<int>(loops.size());
    BitGraph consistency(n);
    for (int a = 0; a < n; ++a)
      for (int b = a + 1; b < n; ++b)
        if (ring_misclosure(loops[a], loops[b], chain).chi2 <= gate) consistency.join(a, b);
    sets.emplace_back();
    for (const int i : max_clique(consistency, max_steps).vertices)
      sets.back().push_back(loops[i].edge);
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
