#include <gtest/gtest.h>
#include <placegraph/backend/robust/max_clique.h>
#include <placegraph/graph/core/random.h>

#include <bit>

namespace placegraph {
namespace max_clique_test {

BitGraph random_graph(int vertices, double density, std::uint64_t seed) {
  Random random(seed);
  BitGraph graph(vertices);
  for (int a = 0; a < vertices; ++a)
    for (int b = a + 1; b < vertices; ++b)
      if (random.uniform() < density) graph.join(a, b);
  return graph;
}

bool is_clique(const BitGraph& graph, const std::vector<int>& vertices) {
  for (const int a : vertices)
    for (const int b : vertices)
      if (a != b && !graph.joined(a, b)) return false;
  return true;
}

/// Size of the largest clique, by trying every set of vertices.
int largest_by_trying(const BitGraph& graph) {
  int largest = 0;
  for (unsigned set = 0; set < 1u << graph.vertices(); ++set) {
    std::vector<int> vertices;
    for (int v = 0; v < graph.vertices(); ++v)
      if (set >> v & 1) vertices.push_back(v);
    if (static_cast<int>(vertices.size()) > largest && is_clique(graph, vertices))
      largest = static_cast<int>(vertices.size());
  }
  return largest;
}

TEST(MaxClique, IsAsLargeAsTryingEverySetFinds) {
  for (const double density : {0.0, 0.2, 0.5, 0.8, 1.0})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const BitGraph graph = random_graph(11, density, seed);
      const Clique clique = max_clique(graph, 1000000);
      EXPECT_TRUE(clique.proven);
      EXPECT_TRUE(is_clique(graph, clique.vertices));
      EXPECT_EQ(static_cast<int>(clique.vertices.size()), largest_by_trying(graph))
          << "density " << density << " seed " << seed;
    }
}

TEST(MaxClique, IsAsHeavyAsTryingEverySetFinds) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const BitGraph graph = random_graph(11, 0.5, seed);
    std::vector<int> weights;
    for (int v = 0; v < graph.vertices(); ++v) weights.push_back(1 + (7 * v + 3) % 5);
    const auto weight_of = [&](const std::vector<int>& vertices) {
      int sum = 0;
      for (const int v : vertices) sum += weights[static_cast<std::size_t>(v)];
      return sum;
    };
    int heaviest = 0;
    for (int set = 0; set < 1 << graph.vertices(); ++set) {
      std::vector<int> vertices;
      for (int v = 0; v < graph.vertices(); ++v)
        if (set >> v & 1) vertices.push_back(v);
      if (is_clique(graph, vertices)) heaviest = std::max(heaviest, weight_of(vertices));
    }
    const Clique clique = max_clique(graph, 1000000, weights);
    EXPECT_TRUE(clique.proven);
    EXPECT_TRUE(is_clique(graph, clique.vertices));
    EXPECT_EQ(weight_of(clique.vertices), heaviest) << "seed " << seed;
  }
}

TEST(MaxClique, FindsWhatWasHiddenAmongTwoHundredVertices) {
  BitGraph graph = random_graph(200, 0.3, 7);
  std::vector<int> hidden;
  for (int v = 3; v < 200; v += 9) hidden.push_back(v);
  for (const int a : hidden)
    for (const int b : hidden)
      if (a < b) graph.join(a, b);
  const Clique clique = max_clique(graph, 1000000);
  EXPECT_TRUE(clique.proven);
  EXPECT_EQ(clique.vertices, hidden);
}

TEST(MaxClique, GivesACliqueAndNoProofWhereTheSearchIsCutShort) {
  const BitGraph graph = random_graph(150, 0.7, 3);
  const Clique clique = max_clique(graph, 1);
  EXPECT_FALSE(clique.proven);
  EXPECT_TRUE(is_clique(graph, clique.vertices));
  EXPECT_GE(clique.vertices.size(), 5u);
}

TEST(MaxClique, OfNothingIsNothing) {
  EXPECT_TRUE(max_clique(BitGraph(0), 10).vertices.empty());
  EXPECT_EQ(max_clique(BitGraph(3), 10).vertices.size(), 1u);
}

}  // namespace max_clique_test
}  // namespace placegraph
