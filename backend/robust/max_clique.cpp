#include <placegraph/backend/robust/max_clique.h>
#include <placegraph/graph/core/parallel.h>

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

/// Branch and bound from the clique `best`, which it replaces by heavier ones alone.
class Search {
 public:
  Search(const BitGraph& graph, const std::vector<int>& weights, std::int64_t max_steps,
         std::vector<int> best)
      : graph_(graph), weights_(weights), steps_left_(max_steps), best_(std::move(best)) {
    for (const int v : best_) best_weight_ += weights_[static_cast<std::size_t>(v)];
  }

  void run() {
    candidates_.assign(graph_.words(), 0);
    for (int v = 0; v < graph_.vertices(); ++v) candidates_[v / 64] |= std::uint64_t{1} << (v % 64);
    expand(0);
  }
  const std::vector<int>& best() const { return best_; }
  bool complete() const { return steps_left_ > 0; }

 private:
  struct Branch {
    int vertex;
    /// Sum of the largest weights of the colour classes up to that of the vertex: no clique of it
    /// and the vertices before it is heavier.
    std::int64_t bound;
  };

  std::uint64_t* candidates(std::size_t level) { return &candidates_[level * graph_.words()]; }

  /// Appends the candidates of a level that a clique heavier than the best one may begin with, by
  /// colour classes (no two vertices of a class are adjacent).
  void colour(std::size_t level) {
    std::int64_t before = 0;  // sum over the classes before this one
    left_.assign(candidates(level), candidates(level) + graph_.words());
    for (std::size_t first = 0; first < left_.size();) {
      if (left_[first] == 0) {
        ++first;
        continue;
      }
      free_ = left_;
      std::int64_t heaviest = 0;
      for (std::size_t w = first; w < free_.size(); ++w)
        while (free_[w] != 0) {
          const int v = static_cast<int>(64 * w) + std::countr_zero(free_[w]);
          const std::uint64_t* row = graph_.row(v);
          for (std::size_t k = w; k < free_.size(); ++k) free_[k] &= ~row[k];
          const std::uint64_t bit = std::uint64_t{1} << (v % 64);
          free_[w] &= ~bit;
          left_[w] &= ~bit;
          --steps_left_;
          heaviest = std::max<std::int64_t>(heaviest, weights_[static_cast<std::size_t>(v)]);
          if (weight_ + before + heaviest > best_weight_)
            branches_.push_back({v, before + heaviest});
        }
      before += heaviest;
    }
  }

  void expand(std::size_t level) {
    const std::size_t begin = branches_.size(), words = graph_.words();
    colour(level);
    candidates_.resize((level + 2) * words);
    while (branches_.size() > begin) {
      check_interruption();
      const auto [v, bound] = branches_.back();
      if (weight_ + bound <= best_weight_ || !complete()) break;
      branches_.pop_back();
      current_.push_back(v);
      weight_ += weights_[static_cast<std::size_t>(v)];
      bool any = false;
      for (std::size_t w = 0; w < words; ++w) {
        const std::uint64_t next = candidates(level)[w] & graph_.row(v)[w];
        candidates(level + 1)[w] = next;
        any |= next != 0;
      }
      if (any)
        expand(level + 1);
      else if (weight_ > best_weight_)
        best_ = current_, best_weight_ = weight_;
      current_.pop_back();
      weight_ -= weights_[static_cast<std::size_t>(v)];
      candidates(level)[v / 64] &= ~(std::uint64_t{1} << (v % 64));
    }
    branches_.resize(begin);
  }

  const BitGraph& graph_;
  const std::vector<int>& weights_;
  std::int64_t steps_left_;
  std::vector<int> current_, best_;
  std::int64_t weight_ = 0, best_weight_ = 0;  // those of current_ and best_
  Bits candidates_;                            // of all levels, one after the other
  Bits left_, free_;                           // of the level that is being coloured
  std::vector<Branch> branches_;               // of all levels, one after the other
};

/// A maximal clique: from each of the first vertices in turn, the vertices of the graph's order
/// that are adjacent to all taken ones; the heaviest of these.
std::vector<int> greedy_clique(const BitGraph& graph, const std::vector<int>& weights) {
  // Beginnings. Chosen: vertices of false loops among those of highest degree are few.
  constexpr int kBeginnings = 8;
  std::vector<int> best;
  std::int64_t best_weight = 0;
  for (int first = 0; first < std::min(kBeginnings, graph.vertices()); ++first) {
    Bits left(graph.row(first), graph.row(first) + graph.words());
    std::vector<int> clique = {first};
    std::int64_t weight = weights[static_cast<std::size_t>(first)];
    for (std::size_t w = 0; w < left.size(); ++w)
      while (left[w] != 0) {
        const int v = static_cast<int>(64 * w) + std::countr_zero(left[w]);
        clique.push_back(v);
        weight += weights[static_cast<std::size_t>(v)];
        for (std::size_t k = w; k < left.size(); ++k) left[k] &= graph.row(v)[k];
      }
    if (weight > best_weight) best = std::move(clique), best_weight = weight;
  }
  return best;
}

}  // namespace

Clique max_clique(const BitGraph& graph, std::int64_t max_steps, const std::vector<int>& weights) {
  const std::vector<int> order = by_degree(graph);
  const BitGraph sorted = reordered(graph, order);
  std::vector<int> sorted_weights(order.size(), 1);
  if (!weights.empty())
    for (std::size_t i = 0; i < order.size(); ++i)
      sorted_weights[i] = weights[static_cast<std::size_t>(order[i])];
  Search search(sorted, sorted_weights, max_steps, greedy_clique(sorted, sorted_weights));
  search.run();
  Clique clique;
  for (const int v : search.best()) clique.vertices.push_back(order[v]);
  std::sort(clique.vertices.begin(), clique.vertices.end());
  clique.proven = search.complete();
  return clique;
}

}  // namespace placegraph
