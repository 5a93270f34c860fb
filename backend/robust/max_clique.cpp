#include <placegraph/backend/robust/max_clique.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

namespace placegraph {
namespace {

using Bits = std::vector<std::uint64_t>;

/// The same graph with its vertices in another order: new vertex i is old vertex order[i].
BitGraph reordered(const BitGraph& graph, const std::vector<int>& order) {
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<int>(i);
  BitGraph result(graph.vertices());
  for (int a = 0; a < graph.vertices(); ++a)
    for (int b = a + 1; b < graph.vertices(); ++b)
      if (graph.joined(a, b)) result.join(place[a], place[b]);
  return result;
}

std::vector<int> by_degree(const BitGraph& graph) {
  std::vector<int> degree(static_cast<std::size_t>(graph.vertices()), 0);
  for (int v = 0; v < graph.vertices(); ++v)
    for (std::size_t w = 0; w < graph.words(); ++w) degree[v] += std::popcount(graph.row(v)[w]);
  std::vector<int> order(degree.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return degree[a] > degree[b]; });
  return order;
}

class Search {
 public:
  Search(const BitGraph& graph, std::vector<int> weights, std::int64_t max_steps)
      : graph_(graph), weights_(std::move(weights)), steps_left_(max_steps) {}

  void run() {
    Bits all(graph_.words(), 0);
    for (int v = 0; v < graph_.vertices(); ++v) all[v / 64] |= std::uint64_t{1} << (v % 64);
    expand(all);
  }
  const std::vector<int>& best() const { return best_; }
  bool complete() const { return steps_left_ > 0; }

 private:
  /// Vertices of `candidates` by colour classes (no two of a class are adjacent), and for each the
  /// sum of the largest weights of the classes so far, an upper bound of a clique of it and the
  /// vertices before it.
  void colour(Bits candidates, std::vector<int>& vertices, std::vector<std::int64_t>& bound) const {
    std::int64_t before = 0;  // sum over the classes before this one
    while (std::any_of(candidates.begin(), candidates.end(),
                       [](std::uint64_t word) { return word != 0; })) {
      Bits free = candidates;
      std::int64_t heaviest = 0;
      for (std::size_t w = 0; w < free.size(); ++w)
        while (free[w] != 0) {
          const int v = static_cast<int>(64 * w) + std::countr_zero(free[w]);
          const std::uint64_t* row = graph_.row(v);
          for (std::size_t k = w; k < free.size(); ++k) free[k] &= ~row[k];
          const std::uint64_t bit = std::uint64_t{1} << (v % 64);
          free[w] &= ~bit;
          candidates[w] &= ~bit;
          vertices.push_back(v);
          heaviest = std::max<std::int64_t>(heaviest, weights_[static_cast<std::size_t>(v)]);
          bound.push_back(before + heaviest);
        }
      before += heaviest;
    }
  }

  void expand(Bits candidates) {
    std::vector<int> vertices;
    std::vector<std::int64_t> bound;
    colour(candidates, vertices, bound);
    steps_left_ -= static_cast<std::int64_t>(vertices.size());
    for (std::size_t i = vertices.size(); i-- > 0;) {
      if (weight_ + bound[i] <= best_weight_) return;
      if (!complete() && !best_.empty()) return;  // the first branch is searched completely
      const int v = vertices[i];
      current_.push_back(v);
      weight_ += weights_[static_cast<std::size_t>(v)];
      Bits next(candidates.size());
      bool any = false;
      for (std::size_t w = 0; w < next.size(); ++w) {
        next[w] = candidates[w] & graph_.row(v)[w];
        any |= next[w] != 0;
      }
      if (any)
        expand(std::move(next));
      else if (weight_ > best_weight_)
        best_ = current_, best_weight_ = weight_;
      current_.pop_back();
      weight_ -= weights_[static_cast<std::size_t>(v)];
      candidates[v / 64] &= ~(std::uint64_t{1} << (v % 64));
    }
  }

  const BitGraph& graph_;
  std::vector<int> weights_;
  std::int64_t steps_left_;
  std::vector<int> current_, best_;
  std::int64_t weight_ = 0, best_weight_ = 0;  // those of current_ and best_
};

}  // namespace

Clique max_clique(const BitGraph& graph, std::int64_t max_steps, const std::vector<int>& weights) {
  const std::vector<int> order = by_degree(graph);
  const BitGraph sorted = reordered(graph, order);
  std::vector<int> sorted_weights(order.size(), 1);
  if (!weights.empty())
    for (std::size_t i = 0; i < order.size(); ++i)
      sorted_weights[i] = weights[static_cast<std::size_t>(order[i])];
  Search search(sorted, std::move(sorted_weights), max_steps);
  search.run();
  Clique clique;
  for (const int v : search.best()) clique.vertices.push_back(order[v]);
  std::sort(clique.vertices.begin(), clique.vertices.end());
  clique.proven = search.complete();
  return clique;
}

}  // namespace placegraph
