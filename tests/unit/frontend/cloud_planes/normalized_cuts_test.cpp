#include <gtest/gtest.h>
#include <placegraph/frontend/cloud_planes/normalized_cuts.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "tests/support/message_of.h"

namespace placegraph {
namespace normalized_cuts_test {

/// Definition of the normalized cut: cut / assoc(A, V) + cut / assoc(B, V).
double value_of(const std::vector<bool>& second, const std::vector<Affinity>& edges) {
  double cut = 0, assoc[2] = {0, 0};
  for (const Affinity& edge : edges) {
    if (second[edge.a] != second[edge.b]) cut += edge.weight;
    assoc[second[edge.a]] += edge.weight;
    assoc[second[edge.b]] += edge.weight;
  }
  return cut / assoc[0] + cut / assoc[1];
}

/// Two random groups of nodes: all pairs of a group with weights in [0.5, 1], and a tenth of the
/// pairs across with weights of some hundredths. The first node is in the first group.
struct Groups {
  std::vector<Affinity> edges;
  std::vector<bool> second;
};

Groups draw_groups(int nodes, Random& random) {
  Groups groups;
  groups.second.resize(static_cast<std::size_t>(nodes));
  for (int i = 2; i < nodes; ++i) groups.second[i] = i % 2 == 1 || random.uniform() < 0.3;
  groups.second[1] = true;
  for (int a = 0; a < nodes; ++a)
    for (int b = a + 1; b < nodes; ++b) {
      if (groups.second[a] == groups.second[b])
        groups.edges.push_back({a, b, random.uniform(0.5, 1)});
      else if (a + b == 1 || random.uniform() < 0.1)
        groups.edges.push_back({b, a, random.uniform(0.01, 0.03)});
    }
  return groups;
}

std::vector<bool> with_first_node_false(std::vector<bool> second) {
  if (second[0]) second.flip();
  return second;
}

TEST(NormalizedCutOfGraph, HasTheLeastValueOfAllDivisions) {
  Random random(1);
  for (int round = 0; round < 15; ++round) {
    const int nodes = 4 + round % 6;
    const Groups groups = draw_groups(nodes, random);
    const auto cut = normalized_cut(nodes, groups.edges);
    ASSERT_TRUE(cut);
    double least = 3;
    for (int code = 1; code < 1 << (nodes - 1); ++code) {
      std::vector<bool> second(static_cast<std::size_t>(nodes));
      for (int i = 1; i < nodes; ++i) second[i] = code >> (i - 1) & 1;
      least = std::min(least, value_of(second, groups.edges));
    }
    EXPECT_NEAR(cut->value, least, 1e-12) << nodes << " nodes";
    EXPECT_NEAR(value_of(cut->second, groups.edges), cut->value, 1e-12);
  }
}

TEST(NormalizedCutOfGraph, PartsGroupsOfAnySize) {
  // From 41 nodes on the eigenvector comes from Lanczos iterations.
  Random random(2);
  for (const int nodes : {2, 3, 17, 40, 41, 75, 120}) {
    const Groups groups = draw_groups(nodes, random);
    const auto cut = normalized_cut(nodes, groups.edges);
    ASSERT_TRUE(cut) << nodes;
    EXPECT_NEAR(value_of(cut->second, groups.edges), cut->value, 1e-9) << nodes;
    if (nodes <= 3) continue;  // of three, any may be alone
    EXPECT_EQ(with_first_node_false(cut->second), groups.second) << nodes;
  }
}

TEST(NormalizedCutOfGraph, IsTheSameForOtherUnitsOrdersAndNumbers) {
  Random random(3);
  constexpr int kNodes = 50;
  const Groups groups = draw_groups(kNodes, random);
  const auto cut = normalized_cut(kNodes, groups.edges);
  std::vector<Affinity> other = groups.edges;
  for (Affinity& edge : other)
    edge = {kNodes - 1 - edge.b, kNodes - 1 - edge.a, 1000 * edge.weight};
  for (std::size_t i = other.size() - 1; i > 0; --i)
    std::swap(other[i], other[random.index(static_cast<int>(i) + 1)]);
  const auto same = normalized_cut(kNodes, other);
  ASSERT_TRUE(cut && same);
  EXPECT_NEAR(same->value, cut->value, 1e-9);
  std::vector<bool> second(same->second.rbegin(), same->second.rend());
  EXPECT_EQ(with_first_node_false(second), with_first_node_false(cut->second));
}

TEST(NormalizedCutOfGraph, OfAChainLiesAtItsWeakestLink) {
  // Links of weight 1 but for one of 0.1: cut 0.1, and degrees of 2 * links + 0.1 on either side.
  for (const int nodes : {6, 60}) {
    std::vector<Affinity> chain;
    const int weak = nodes / 2;
    for (int i = 1; i < nodes; ++i) chain.push_back({i - 1, i, i == weak ? 0.1 : 1.0});
    const auto cut = normalized_cut(nodes, chain);
    ASSERT_TRUE(cut);
    for (int i = 0; i < nodes; ++i)
      EXPECT_EQ(cut->second[i] == cut->second[0], i < weak) << nodes << ' ' << i;
    EXPECT_NEAR(cut->value, 2 * 0.1 / (2 * (weak - 1) + 0.1), 1e-9);
  }
}

TEST(NormalizedCutOfGraph, AddsAffinitiesOfOnePair) {
  const auto once = normalized_cut(3, {{0, 1, 3}, {1, 2, 1}});
  const auto parts = normalized_cut(3, {{0, 1, 1}, {1, 2, 1}, {1, 0, 2}});
  ASSERT_TRUE(once && parts);
  EXPECT_EQ(with_first_node_false(once->second), with_first_node_false(parts->second));
  // Off goes node 2: cut 1, degrees 3 + 4 and 1.
  EXPECT_NEAR(once->value, 1 / 7.0 + 1, 1e-12);
  EXPECT_NEAR(parts->value, once->value, 1e-12);
  // The only cut of two nodes goes through all that there is.
  EXPECT_NEAR(normalized_cut(2, {{0, 1, 0.3}})->value, 2, 1e-12);
}

TEST(NormalizedCutOfGraph, RefusesGraphsThatAreNone) {
  const auto message = [](int nodes, const std::vector<Affinity>& edges) {
    return test::message_of<ArgumentError>([&] { (void)normalized_cut(nodes, edges); });
  };
  EXPECT_NE(message(1, {}).find("fewer than two nodes"), std::string::npos);
  for (const Affinity& edge :
       {Affinity{0, 3, 1}, Affinity{3, 0, 1}, Affinity{-1, 0, 1}, Affinity{1, 1, 1}})
    EXPECT_NE(message(3, {edge}).find("do not exist"), std::string::npos) << edge.a << edge.b;
}

}  // namespace normalized_cuts_test
}  // namespace placegraph
