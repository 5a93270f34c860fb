#include <placegraph/backend/robust/parallel_odometry.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace placegraph {
namespace {

using Parallel = std::vector<int>;  // edges between the same two nodes

/// T_a_b of an edge between a and b, for either direction of the edge.
template <class Group>
Group motion(const PackedGraph<Group>& graph, int edge, int a) {
  const auto& e = graph.edges[edge];
  return e.from == a ? e.T_to_from.inverse() : e.T_to_from;
}

template <class Group>
std::vector<Parallel> parallel_odometry(const PackedGraph<Group>& graph) {
  std::map<std::pair<int, int>, Parallel> by_ends;
  for (std::size_t i = 0; i < graph.edges.size(); ++i)
    if (graph.edges[i].odometry)
      by_ends[std::minmax(graph.edges[i].from, graph.edges[i].to)].push_back(static_cast<int>(i));
  std::vector<Parallel> result;
  for (auto& [ends, edges] : by_ends) {
    if (edges.size() < 2) continue;
    const int a = ends.first;
    std::sort(edges.begin(), edges.end(), [&](int i, int j) {
      const double trace_i = graph.edges[i].information.trace();
      const double trace_j = graph.edges[j].information.trace();
      if (trace_i != trace_j) return trace_i > trace_j;
      const auto log_i = motion(graph, i, a).log(), log_j = motion(graph, j, a).log();
      return std::lexicographical_compare(log_i.begin(), log_i.end(), log_j.begin(), log_j.end());
    });
    result.push_back(std::move(edges));
  }
  return result;
}

/// A ring of one loop and the odometry between its ends, or of two loops (`b` >= 0) and theirs.
struct Ring {
  int length;  ///< steps of odometry
  int a, b;    ///< positions in the vector of loops
};

/// The loops, odometry and poses with which edges of parallel odometry are compared.
template <class Group>
class Surroundings {
 public:
  Surroundings(const PackedGraph<Group>& graph, const LoopSupportOptions& options)
      : graph_(graph), chain_(graph), loops_(loops_on_chain(graph, chain_)) {
    std::erase_if(loops_,
                  [&](const auto& loop) { return chain_.repeats_step(loop.from, loop.to); });
    for (const LoopPair& pair :
         neighbouring_pairs(loops_, chain_, options.reach, options.neighbours))
      pairs_.push_back({steps(loops_[pair.a].from, loops_[pair.b].from) +
                            steps(loops_[pair.a].to, loops_[pair.b].to),
                        pair.a, pair.b});
    unit_ = Group::kDof * support_loops(graph, chain_, options).noise_scale;
  }

  /// The edge between two nodes that fits best; the first of them is on the chain.
  int best_of(const Parallel& edges) const {
    const int chosen = chosen_of(edges), u = graph_.edges[chosen].from, v = graph_.edges[chosen].to;
    const std::vector<Ring> rings =
        chain_.repeats_step(u, v) ? shortest_rings(u, v) : std::vector<Ring>{};
    int best = chosen;
    double least = std::numeric_limits<double>::infinity();
    for (const int edge : edges) {
      const double misfit = misfit_of(edge, edges, rings, u, v);
      if (misfit < least) {
        least = misfit;
        best = edge;
      }
    }
    return best;
  }

  int chosen_of(const Parallel& edges) const {
    return *std::find_if(edges.begin(), edges.end(),
                         [&](int edge) { return graph_.edges[edge].odometry; });
  }

 private:
  int steps(int a, int b) const { return std::abs(chain_.position(a) - chain_.position(b)); }
  double cost(double chi2) const { return std::log1p(chi2 / unit_); }

  /// Whether the step from `u` to `v` is between `a` and `b`.
  bool between(int u, int v, int a, int b) const {
    if (chain_.run(a) != chain_.run(u) || chain_.run(b) != chain_.run(u)) return false;
    const int before = std::min(chain_.position(u), chain_.position(v));
    return (chain_.position(a) <= before) != (chain_.position(b) <= before);
  }

  std::vector<Ring> shortest_rings(int u, int v) const {
    // Rings of a pair, the shortest ones: the cost. Chosen.
    constexpr std::size_t kRings = 20;
    std::vector<Ring> rings;
    for (std::size_t i = 0; i < loops_.size(); ++i)
      if (between(u, v, loops_[i].from, loops_[i].to))
        rings.push_back({steps(loops_[i].from, loops_[i].to), static_cast<int>(i), -1});
    for (const Ring& pair : pairs_)
      if (between(u, v, loops_[pair.a].from, loops_[pair.b].from) ||
          between(u, v, loops_[pair.a].to, loops_[pair.b].to))
        rings.push_back(pair);
    const std::size_t n = std::min(rings.size(), kRings);
    std::partial_sort(rings.begin(), rings.begin() + static_cast<std::ptrdiff_t>(n), rings.end(),
                      [](const Ring& x, const Ring& y) {
                        return std::tie(x.length, x.a, x.b) < std::tie(y.length, y.a, y.b);
                      });
    rings.resize(n);
    return rings;
  }

  double misfit_of(int edge, const Parallel& edges, const std::vector<Ring>& rings, int u,
                   int v) const {
    const Group T_u_v = motion(graph_, edge, u);
    const auto& information = graph_.edges[edge].information;
    const typename Group::Tangent at_poses =
        (T_u_v.inverse() * (graph_.poses[u].inverse() * graph_.poses[v])).log();
    double sum = cost(at_poses.dot(information * at_poses));
    if (edges.size() > 2)
      for (const int other : edges) {
        const typename Group::Tangent e = (motion(graph_, other, u).inverse() * T_u_v).log();
        sum += cost(0.5 * e.dot(graph_.edges[other].information * e));
      }
    // With this edge on the chain, all later poses of the run move by D.
    Group D = chain_.pose(u) * T_u_v * chain_.pose(v).inverse();
    if (chain_.position(u) > chain_.position(v))
      D = chain_.pose(v) * T_u_v.inverse() * chain_.pose(u).inverse();
    const Group back = D.inverse();
    const int run = chain_.run(u), before = std::min(chain_.position(u), chain_.position(v));
    const auto moves = [&](int node) {
      return chain_.run(node) == run && chain_.position(node) > before;
    };
    const auto moved = [&](LoopOnChain<Group> loop) {
      if (moves(loop.from)) loop.W = D * loop.W;
      if (moves(loop.to)) loop.W = loop.W * back;
      return loop;
    };
    for (const Ring& ring : rings)
      sum += cost(ring.b < 0
                      ? drift_misclosure(moved(loops_[ring.a]), chain_).chi2
                      : ring_misclosure(moved(loops_[ring.a]), moved(loops_[ring.b]), chain_).chi2);
    return sum;
  }

  const PackedGraph<Group>& graph_;
  OdometryChain<Group> chain_;
  std::vector<LoopOnChain<Group>> loops_;
  std::vector<Ring> pairs_;
  double unit_;
};

}  // namespace

template <class Group>
int set_parallel_odometry_apart(PackedGraph<Group>& graph, const LoopSupportOptions& options) {
  const std::vector<Parallel> parallel = parallel_odometry(graph);
  if (parallel.empty()) return 0;
  int apart = 0;
  for (const Parallel& edges : parallel) {
    apart += static_cast<int>(edges.size()) - 1;
    for (const int edge : edges) graph.edges[edge].odometry = edge == edges.front();
  }
  // The rings of a step contain other steps with parallel edges: repeats while the selection
  // changes.
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    const Surroundings<Group> surroundings(graph, options);
    std::vector<std::pair<int, int>> changes;
    for (const Parallel& edges : parallel) {
      const int chosen = surroundings.chosen_of(edges), best = surroundings.best_of(edges);
      if (best != chosen) changes.emplace_back(chosen, best);
    }
    for (const auto& [chosen, best] : changes) {
      graph.edges[chosen].odometry = false;
      graph.edges[best].odometry = true;
    }
    if (changes.empty()) break;
  }
  return apart;
}

template int set_parallel_odometry_apart(PackedGraph<SE2>&, const LoopSupportOptions&);
template int set_parallel_odometry_apart(PackedGraph<SE3>&, const LoopSupportOptions&);
template int set_parallel_odometry_apart(PackedGraph<Sim3>&, const LoopSupportOptions&);

}  // namespace placegraph
