#include <placegraph/backend/robust/loop_gate.h>
#include <placegraph/backend/robust/loop_leverage.h>
#include <placegraph/backend/robust/loop_set_growth.h>
#include <placegraph/backend/solver/subset_solver.h>
#include <placegraph/graph/core/disjoint_sets.h>

#include <algorithm>
#include <numeric>

namespace placegraph {
namespace {

using Cluster = std::vector<int>;  // loops, as positions in PackedGraph::edges

LocalSolverOptions roughly(LocalSolverOptions options) {
  options.relative_decrease = std::max(options.relative_decrease, 1e-4);
  return options;
}

/// Sets the weight of the loops of least error that connect parts of the graph to the rest.
template <class Group>
void reconnect(PackedGraph<Group>& graph, const std::vector<double>& chi2) {
  DisjointSets sets(graph.poses.size());
  std::vector<int> without;
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    if (graph.edges[i].weight > 0)
      sets.join(graph.edges[i].from, graph.edges[i].to);
    else
      without.push_back(static_cast<int>(i));
  }
  std::sort(without.begin(), without.end(), [&](int a, int b) { return chi2[a] < chi2[b]; });
  for (const int i : without) {
    auto& edge = graph.edges[i];
    if (sets.root(edge.from) == sets.root(edge.to)) continue;
    sets.join(edge.from, edge.to);
    edge.weight = 1;
  }
}

/// The state of a loop set growth; loops with nonzero weight are accepted.
template <class Group>
class Growth {
 public:
  Growth(PackedGraph<Group>& graph, const LoopSupport& support, double probability,
         const LocalSolverOptions& solver, const LoopSetGrowthOptions& options,
         const GncOptions& gnc)
      : graph_(graph),
        clusters_(support.clusters),
        rough_(roughly(solver)),
        max_rounds_(options.max_rounds),
        gnc_(gnc),
        gate_(graph, probability, support.noise_scale,
              {options.margin, options.tail, options.nearly_right}),
        rough_solver_(rough_) {}

  double noise_scale() const { return gate_.noise_scale(); }

  /// Steps 1 and 2: from the largest group to groups of two.
  void take_groups() {
    for (auto& edge : graph_.edges)
      if (!edge.odometry) edge.weight = 0;
    reconnect(graph_, chi2());
    bool first = true;
    for (std::size_t least = clusters_.empty() ? 0 : clusters_.front().size(); least >= 2;
         least = least > 2 ? std::max<std::size_t>(2, least / 2) : 0) {
      std::vector<int> candidates;
      for (std::size_t i = 0; i < clusters_.size() && clusters_[i].size() >= least; ++i)
        if (!taken(clusters_[i])) candidates.push_back(static_cast<int>(i));
      if (!first) candidates = those_it_can_follow(candidates);
      if (!candidates.empty()) take(candidates);
      first = false;
    }
  }

  /// Step 3.
  void settle() {
    const std::vector<char> every(graph_.edges.size(), true);
    for (int round = 0; round < max_rounds_; ++round) {
      if (test(every) == 0 && take_lone() == 0) break;
      (void)rough_solver_.solve(graph_);
    }
  }

 private:
  std::vector<double> chi2() const { return chi2_by_edge(graph_, rough_.rotation_error); }

  bool taken(const Cluster& cluster) const {
    const auto n = std::count_if(cluster.begin(), cluster.end(),
                                 [&](int edge) { return graph_.edges[edge].weight > 0; });
    return 2 * static_cast<std::size_t>(n) >= cluster.size();
  }

  std::vector<int> those_it_can_follow(const std::vector<int>& candidates) const {
    if (candidates.empty()) return {};
    std::vector<int> middle;  // one representative loop of each group
    for (const int c : candidates) middle.push_back(clusters_[c][clusters_[c].size() / 2]);
    const auto gate_of = [&](int c) {
      return static_cast<double>(clusters_[c].size()) * gate_.of_noise();
    };
    const std::vector<double> cost =
        cost_of_adding(graph_, middle, rough_.rotation_error, gate_of(candidates.front()));
    std::vector<int> result;
    for (std::size_t i = 0; i < cost.size(); ++i)
      if (cost[i] <= gate_of(candidates[i])) result.push_back(candidates[i]);
    return result;
  }

  void take(const std::vector<int>& candidates) {
    for (const int c : candidates)
      for (const int edge : clusters_[c]) graph_.edges[edge].weight = 1;
    (void)graduated_non_convexity(graph_, gate_.of_noise(), rough_, gnc_);
    // Groups are accepted or dropped as a whole; every loop of the accepted groups is tested again
    // with the updated noise.
    std::vector<char> in_question(graph_.edges.size(), false);
    for (const Cluster& cluster : clusters_) {
      const bool stands = taken(cluster);
      for (const int edge : cluster) {
        if (!stands) graph_.edges[edge].weight = 0;
        in_question[edge] = stands;
      }
    }
    // Rounds of a test until nothing changes, at most. Chosen.
    constexpr int kRounds = 3;
    for (int round = 0; round < kRounds && test(in_question) > 0; ++round)
      (void)rough_solver_.solve(graph_);
  }

  /// Accepts the loops in question whose error at the current poses is within the limit and drops
  /// the others; returns the number of changes.
  int test(const std::vector<char>& in_question) {
    const std::vector<double> error = chi2();
    gate_.learn(graph_, error);
    std::vector<double> before;
    for (const auto& edge : graph_.edges) before.push_back(edge.weight);
    for (std::size_t i = 0; i < graph_.edges.size(); ++i)
      if (in_question[i] && !graph_.edges[i].odometry)
        graph_.edges[i].weight = error[i] <= gate_.of_loop(graph_, static_cast<int>(i)) ? 1 : 0;
    reconnect(graph_, error);
    int changed = 0;
    for (std::size_t i = 0; i < graph_.edges.size(); ++i)
      changed += graph_.edges[i].weight != before[i];
    return changed;
  }

  /// Accepts loops that do not agree with the solution but to which it can adapt.
  int take_lone() {
    std::vector<int> left;
    for (std::size_t i = 0; i < graph_.edges.size(); ++i)
      if (graph_.edges[i].weight == 0) left.push_back(static_cast<int>(i));
    const std::vector<double> cost =
        cost_of_adding(graph_, left, rough_.rotation_error, gate_.widest());
    std::vector<std::size_t> order(cost.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return cost[a] < cost[b]; });
    int added = 0;
    for (const std::size_t i : order) {
      if (cost[i] > gate_.of_loop(graph_, left[i])) continue;
      gate_.widen(cost[i]);
      graph_.edges[left[i]].weight = 1;
      ++added;
    }
    return added;
  }

  PackedGraph<Group>& graph_;
  const std::vector<Cluster>& clusters_;
  LocalSolverOptions rough_;
  int max_rounds_;
  GncOptions gnc_;
  LoopGate<Group> gate_;
  SubsetSolver<Group> rough_solver_;
};

}  // namespace

namespace {

template <class Group>
LoopSetGrowth finish(Growth<Group>& growth, PackedGraph<Group>& graph,
                     const LocalSolverOptions& solver) {
  growth.settle();
  LoopSetGrowth result;
  result.local = SubsetSolver<Group>(solver).solve(graph);
  result.noise_scale = growth.noise_scale();
  return result;
}

}  // namespace

template <class Group>
LoopSetGrowth extend_loop_set(PackedGraph<Group>& graph, const LoopSupport& support,
                              double probability, const LocalSolverOptions& solver,
                              const LoopSetGrowthOptions& options, const GncOptions& gnc) {
  options.check();
  Growth<Group> growth(graph, support, probability, solver, options, gnc);
  growth.take_groups();
  return finish(growth, graph, solver);
}

template <class Group>
LoopSetGrowth settle_loops(PackedGraph<Group>& graph, const LoopSupport& support,
                           double probability, const LocalSolverOptions& solver,
                           const LoopSetGrowthOptions& options, const GncOptions& gnc) {
  options.check();
  Growth<Group> growth(graph, support, probability, solver, options, gnc);
  return finish(growth, graph, solver);
}

#define PLACEGRAPH_INSTANTIATE(Group)                                                            \
  template LoopSetGrowth extend_loop_set(PackedGraph<Group>&, const LoopSupport&, double,        \
                                         const LocalSolverOptions&, const LoopSetGrowthOptions&, \
                                         const GncOptions&);                                     \
  template LoopSetGrowth settle_loops(PackedGraph<Group>&, const LoopSupport&, double,           \
                                      const LocalSolverOptions&, const LoopSetGrowthOptions&,    \
                                      const GncOptions&);
PLACEGRAPH_INSTANTIATE(SE2)
PLACEGRAPH_INSTANTIATE(SE3)
PLACEGRAPH_INSTANTIATE(Sim3)
#undef PLACEGRAPH_INSTANTIATE

}  // namespace placegraph
