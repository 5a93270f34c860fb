#include <gtest/gtest.h>
#include <placegraph/graph/scene/decision_forest.h>

#include <algorithm>

#include "tests/support/seed.h"

namespace placegraph {
namespace decision_forest_test {

constexpr int kClasses = 3, kDimension = 5;

/// Appends a random tree of at most this depth, its leaves with a sum of 255.
void grow(DecisionForest& forest, int depth, Random& random) {
  const std::size_t at = forest.nodes.size();
  forest.nodes.emplace_back();
  if (depth == 0 || random.index(4) == 0) {
    forest.nodes[at].other = static_cast<std::uint32_t>(forest.leaves.size() / kClasses);
    const int first = random.index(256), second = random.index(256 - first);
    for (const int share : {first, second, 255 - first - second})
      forest.leaves.push_back(static_cast<std::uint8_t>(share));
    return;
  }
  grow(forest, depth - 1, random);
  const auto other = static_cast<std::uint32_t>(forest.nodes.size());
  forest.nodes[at] = {static_cast<std::uint16_t>(random.index(kDimension)),
                      static_cast<std::uint16_t>(random.index(256)), other};
  grow(forest, depth - 1, random);
}

DecisionForest random_forest(Random& random, int trees = 4) {
  DecisionForest forest;
  forest.classes = kClasses;
  forest.dimension = kDimension;
  for (int i = 0; i < trees; ++i) {
    forest.roots.push_back(static_cast<std::uint32_t>(forest.nodes.size()));
    grow(forest, 5, random);
  }
  return forest;
}

std::vector<std::uint8_t> random_row(Random& random) {
  std::vector<std::uint8_t> row;
  for (int i = 0; i < kDimension; ++i) row.push_back(static_cast<std::uint8_t>(random.index(256)));
  return row;
}

std::vector<float> shares_of(const DecisionForest& forest, const std::vector<std::uint8_t>& row) {
  std::vector<float> shares(kClasses, -1);
  forest.predict(row.data(), shares.data());
  return shares;
}

/// The leaf of a row, by the meaning of a tree: small values are on the left of a node.
std::uint32_t leaf_below(const DecisionForest& forest, std::uint32_t node,
                         const std::vector<std::uint8_t>& row) {
  const DecisionForest::Node& n = forest.nodes[node];
  if (n.feature == DecisionForest::kLeaf) return n.other;
  return leaf_below(forest, row[n.feature] > n.threshold ? n.other : node + 1, row);
}

TEST(DecisionForest, PredictsTheMeanOfItsTreesInAnyOrder) {
  Random random = test::seeded_random(31);
  for (int trial = 0; trial < 100; ++trial) {
    DecisionForest forest = random_forest(random);
    ASSERT_FALSE(forest.problem()) << *forest.problem();
    const std::vector<std::uint8_t> row = random_row(random);
    std::vector<double> mean(kClasses, 0);
    for (const std::uint32_t root : forest.roots)
      for (std::size_t c = 0; c < kClasses; ++c)
        mean[c] += forest.leaves[leaf_below(forest, root, row) * kClasses + c] / (255.0 * 4);
    const std::vector<float> shares = shares_of(forest, row);
    for (std::size_t c = 0; c < kClasses; ++c) EXPECT_NEAR(shares[c], mean[c], 1e-6);
    std::ranges::reverse(forest.roots);
    EXPECT_EQ(shares_of(forest, row), shares);  // sums of whole numbers
  }
}

TEST(DecisionForest, LeavesThatSayNothingGiveEqualShares) {
  Random random = test::seeded_random(32);
  DecisionForest forest = random_forest(random);
  std::ranges::fill(forest.leaves, std::uint8_t{0});
  for (const float share : shares_of(forest, random_row(random)))
    EXPECT_FLOAT_EQ(share, 1.0F / kClasses);
}

TEST(DecisionForest, WhatItCallsSoundCanBeDescended) {
  Random random = test::seeded_random(33);
  int sound = 0, broken = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    DecisionForest forest = random_forest(random, 2);
    const auto size = static_cast<int>(forest.nodes.size());
    DecisionForest::Node& node = forest.nodes[static_cast<std::size_t>(random.index(size))];
    if (node.feature == DecisionForest::kLeaf || random.index(2) == 0)
      node.other = static_cast<std::uint32_t>(random.index(size + 3));
    else
      node.feature = static_cast<std::uint16_t>(random.index(2 * kDimension));
    ++(forest.problem() ? broken : sound);
    if (forest.problem()) continue;
    for (std::size_t i = 0; i < forest.nodes.size(); ++i) {
      const DecisionForest::Node& n = forest.nodes[i];
      if (n.feature == DecisionForest::kLeaf) {
        ASSERT_LT(n.other, forest.leaves.size() / kClasses);
        continue;
      }
      ASSERT_LT(n.feature, kDimension);
      ASSERT_LT(i + 1, forest.nodes.size());
      ASSERT_LT(n.other, forest.nodes.size());
      ASSERT_GT(n.other, i);  // each step leads on: a way down has an end
    }
  }
  EXPECT_GE(sound, 100);
  EXPECT_GE(broken, 100);
}

TEST(DecisionForest, NamesSizesThatDoNotAgree) {
  Random random = test::seeded_random(34);
  const DecisionForest good = random_forest(random);
  DecisionForest bad = good;
  bad.roots.clear();
  EXPECT_EQ(bad.problem(), "no classes, no features or no tree");
  bad = good;
  bad.roots[1] = static_cast<std::uint32_t>(bad.nodes.size());
  EXPECT_EQ(bad.problem(), "a tree without a root");
  bad = good;
  bad.leaves.pop_back();
  EXPECT_EQ(bad.problem(), "the leaves do not fit the number of classes");
  bad = good;
  bad.leaves.resize(bad.leaves.size() - kClasses);  // that of the last node
  EXPECT_EQ(bad.problem(), "node " + std::to_string(bad.nodes.size() - 1) +
                               ": its leaf does not exist");
  EXPECT_TRUE(DecisionForest().problem());
}

}  // namespace decision_forest_test
}  // namespace placegraph
