#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace placegraph {

/// An undirected graph as one row of bits for every vertex.
class BitGraph {
 public:
  explicit BitGraph(int vertices)
      : vertices_(vertices),
        words_((static_cast<std::size_t>(vertices) + 63) / 64),
        bits_(words_ * static_cast<std::size_t>(vertices), 0) {}

  int vertices() const { return vertices_; }
  std::size_t words() const { return words_; }
  const std::uint64_t* row(int v) const { return &bits_[words_ * static_cast<std::size_t>(v)]; }
  bool joined(int a, int b) const { return row(a)[b / 64] >> (b % 64) & 1; }
  /// Adds an edge between a and b, a != b.
  void join(int a, int b) {
    point(a, b);
    point(b, a);
  }
  /// Adds b to the row of a alone: rows may be filled by different threads; `mirror` follows.
  void point(int a, int b) {
    bits_[words_ * static_cast<std::size_t>(a) + b / 64] |= std::uint64_t{1} << (b % 64);
  }
  /// Adds the opposite of every entry.
  void mirror() {
    for (int a = 0; a < vertices_; ++a)
      for (int b = a + 1; b < vertices_; ++b)
        if (joined(a, b) || joined(b, a)) join(a, b);
  }

 private:
  int vertices_;
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

struct Clique {
  std::vector<int> vertices;  ///< ascending
  bool proven = false;        ///< whether no clique is heavier; else the search reached its limit
};

/// A set of pairwise adjacent vertices with the largest sum of `weights`, which are positive, one a
/// vertex; without weights, a largest set.
/// Branch and bound with greedy colouring (Tomita & Kameda 2007, on bit sets as San Segundo et al.
/// 2011), from a greedy clique of vertices of high degree. `max_steps` (coloured vertices) limits
/// the search by count, not by time, so that the same graph has the same result; time and memory
/// are quadratic in the vertices at most. Boost.Graph only lists all maximal cliques, which are too
/// many here; it has no branch-and-bound search for the largest one.
Clique max_clique(const BitGraph& graph, std::int64_t max_steps,
                  const std::vector<int>& weights = {});

}  // namespace placegraph
