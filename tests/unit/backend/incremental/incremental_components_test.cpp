#include <gtest/gtest.h>
#include <placegraph/backend/incremental/incremental_components.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <set>

namespace placegraph {
namespace incremental_components_test {

/// The same by search over all nodes: a component is a set of nodes.
struct PlainComponents {
  std::vector<char> fixed;
  std::vector<int> positions;
  std::vector<std::set<int>> components;

  const std::set<int>& of(int node) const {
    return *std::find_if(components.begin(), components.end(),
                         [&](const auto& nodes) { return nodes.count(node) > 0; });
  }
  bool anchored(const std::set<int>& nodes) const {
    return std::any_of(nodes.begin(), nodes.end(),
                       [&](int node) { return fixed[node] || positions[node] > 0; });
  }
  bool held(int node) const {
    return fixed[node] || (!anchored(of(node)) && node == *of(node).begin());
  }
  /// Of two components the one that moves to the other.
  std::set<int> join(int a, int b) {
    const std::set<int> x = of(a), y = of(b);
    const bool later_moves = anchored(x) == anchored(y);
    const bool y_moves = later_moves ? *x.begin() < *y.begin() : anchored(x);
    const std::set<int> moves = y_moves ? y : x;
    const std::set<int> result = anchored(moves) ? std::set<int>() : moves;
    std::erase_if(components, [&](const auto& nodes) { return nodes == x || nodes == y; });
    components.push_back(x);
    components.back().insert(y.begin(), y.end());
    return result;
  }
  void split(const std::vector<int>& part) {
    auto& whole = const_cast<std::set<int>&>(of(part.front()));
    if (whole.size() == part.size()) return;
    for (const int node : part) whole.erase(node);
    components.emplace_back(part.begin(), part.end());
  }
};

TEST(IncrementalComponents, HoldJoinAndSplitAsASearchOverAllNodesDoes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    IncrementalComponents components;
    PlainComponents plain;
    std::vector<char> held;
    for (int step = 0; step < 120; ++step) {
      const int n = static_cast<int>(plain.fixed.size());
      const double choice = random.uniform();
      const int a = n > 0 ? random.index(n) : 0, b = n > 0 ? random.index(n) : 0;
      if (n < 2 || choice < 0.25) {
        const bool fixed = random.uniform() < 0.15;
        ASSERT_EQ(components.add_node(fixed), n);
        plain.fixed.push_back(fixed);
        plain.positions.push_back(0);
        plain.components.push_back({n});
        held.push_back(components.held(n));
      } else if (choice < 0.6) {
        if (components.together(a, b)) continue;
        const std::vector<int> moved = components.join(a, b);
        EXPECT_EQ(std::set<int>(moved.begin(), moved.end()), plain.join(a, b))
            << "seed " << seed << " step " << step;
      } else if (choice < 0.8) {
        // Pieces of the components of two nodes, with all of their pieces or without one.
        std::vector<std::vector<int>> pieces;
        for (const int whole : {a, b}) {
          if (whole == b && components.together(a, b)) break;
          std::vector<std::vector<int>> parts(1 + random.index(4));
          for (const int node : plain.of(whole)) parts[random.index(parts.size())].push_back(node);
          std::erase_if(parts, [](const auto& part) { return part.empty(); });
          if (random.uniform() < 0.5) parts.pop_back();
          pieces.insert(pieces.end(), parts.begin(), parts.end());
        }
        components.split(pieces);
        for (const std::vector<int>& piece : pieces) plain.split(piece);
      } else {
        const int count = plain.positions[a] > 0 && random.uniform() < 0.6 ? -1 : 1;
        components.anchor(a, count);
        plain.positions[a] += count;
      }
      for (const int node : components.take_changed()) held[node] = components.held(node);
      for (int node = 0; node < static_cast<int>(plain.fixed.size()); ++node) {
        ASSERT_EQ(components.held(node), plain.held(node))
            << "seed " << seed << " step " << step << " node " << node;
        ASSERT_EQ(held[node] != 0, plain.held(node))
            << "a change was not reported: seed " << seed << " step " << step << " node " << node;
        ASSERT_EQ(components.together(a, node), plain.of(a).count(node) > 0);
      }
    }
  }
}

TEST(IncrementalComponents, ReportEveryChangeOnce) {
  IncrementalComponents components;
  components.add_node(false);
  components.add_node(false);
  EXPECT_TRUE(components.take_changed().empty()) << "a new node is held from the start";
  components.join(0, 1);
  EXPECT_EQ(components.take_changed(), std::vector<int>{1});
  EXPECT_TRUE(components.take_changed().empty());
  components.anchor(1, 1);
  EXPECT_EQ(components.take_changed(), std::vector<int>{0});
  components.anchor(1, 1);
  components.anchor(1, -1);
  EXPECT_TRUE(components.take_changed().empty()) << "one measured position is left";
}

}  // namespace incremental_components_test
}  // namespace placegraph
