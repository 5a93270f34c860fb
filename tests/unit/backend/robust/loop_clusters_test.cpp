#include <gtest/gtest.h>
#include <placegraph/backend/robust/loop_clusters.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/support/packed_graphs.h"
#include "tests/support/scenes/looped_walk.h"

namespace placegraph {
namespace loop_clusters_test {

/// The rings of the given covariance `variance` * I: closing ones with noise of `scale` times that,
/// then as many anywhere in a box of 200 units.
std::vector<LoopPair> rings(int closing, int anywhere, int dof, double scale, double variance,
                            std::uint64_t seed) {
  Random random(seed);
  std::vector<LoopPair> pairs;
  for (int i = 0; i < closing + anywhere; ++i) {
    double chi2 = 0;
    for (int k = 0; k < dof; ++k) {
      const double e =
          i < closing ? random.normal(0, std::sqrt(scale * variance)) : random.uniform(-100, 100);
      chi2 += e * e / variance;
    }
    pairs.push_back({i, i + 1, {chi2, dof * std::log(variance)}});
  }
  return pairs;
}

TEST(RingMixture, FindsTheNoiseOfTheRingsThatCloseAndTellsThemFromTheOthers) {
  for (const int dof : {3, 6, 7})
    for (const double scale : {0.01, 1.0, 25.0}) {
      constexpr int kClosing = 300, kAnywhere = 200;
      const auto pairs = rings(kClosing, kAnywhere, dof, scale, 0.01, 7);
      const RingMixture mixture = fit_rings(pairs, {}, dof, std::pow(200, dof));
      EXPECT_TRUE(mixture.scale_is_known);
      // The mean of n dof squares has a relative deviation of sqrt(2 / (n dof)): four of them.
      EXPECT_NEAR(mixture.noise_scale, scale, 4 * std::sqrt(2.0 / (kClosing * dof)) * scale);
      ASSERT_EQ(mixture.probability.size(), pairs.size());
      for (int i = 0; i < kClosing + kAnywhere; ++i) {
        // Far out in the tail of the noise a ring may count as another one.
        if (i < kClosing && pairs[i].ring.chi2 > 3 * dof * scale) continue;
        EXPECT_EQ(mixture.probability[i] > 0.5, i < kClosing) << "dof " << dof << " ring " << i;
      }
    }
}

TEST(RingMixture, OnlyMultipliesItsScaleByACommonFactorOfAllInformation) {
  const auto pairs = rings(100, 80, 3, 1, 0.01, 8);
  const RingMixture expected = fit_rings(pairs, {}, 3, 8e6);
  for (const double factor : {1e-4, 16.0, 1e6}) {
    auto scaled = pairs;
    for (LoopPair& pair : scaled) {
      pair.ring.chi2 *= factor;
      pair.ring.log_determinant -= 3 * std::log(factor);
    }
    const RingMixture mixture = fit_rings(scaled, {}, 3, 8e6);
    EXPECT_NEAR(mixture.noise_scale, factor * expected.noise_scale, 1e-6 * mixture.noise_scale);
    for (std::size_t i = 0; i < pairs.size(); ++i)
      EXPECT_NEAR(mixture.probability[i], expected.probability[i], 1e-6);
  }
}

TEST(RingMixture, AsksTheOdometryIfNoRingsAreThere) {
  std::vector<RingMisclosure> drift;
  for (const LoopPair& pair : rings(200, 0, 3, 4, 0.01, 9)) drift.push_back(pair.ring);
  const RingMixture mixture = fit_rings({}, drift, 3, 8e6);
  EXPECT_TRUE(mixture.scale_is_known);
  EXPECT_NEAR(mixture.noise_scale, 4, 4 * 4 * std::sqrt(2.0 / 600));
  EXPECT_TRUE(mixture.probability.empty());
  drift.resize(3);
  for (const RingMixture& unknown : {fit_rings({}, drift, 3, 8e6), fit_rings({}, {}, 3, 8e6)}) {
    EXPECT_FALSE(unknown.scale_is_known);
    EXPECT_EQ(unknown.noise_scale, 1);
  }
}

template <class Group>
class LoopSupportOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(LoopSupportOf, Groups);

TYPED_TEST(LoopSupportOf, PutsEveryLoopInOneClusterAndRepeatedStepsLast) {
  const test::LoopedWalk<TypeParam> walk(
      {.nodes = 120, .lap = 30, .noise = 0.02, .claimed = 0.02, .false_loops = 30});
  PackedGraph<TypeParam> graph = pack<TypeParam>(walk.graph);
  for (const int step : {10, 40, 40}) {
    graph.edges.push_back(graph.edges[step]);
    graph.edges.back().odometry = false;
  }
  const OdometryChain<TypeParam> chain(graph);
  const LoopSupport support = support_loops(graph, chain, {});
  EXPECT_TRUE(support.scale_is_known);
  std::set<int> seen, expected;
  for (const auto& cluster : support.clusters) seen.insert(cluster.begin(), cluster.end());
  for (std::size_t i = 0; i < graph.edges.size(); ++i)
    if (!graph.edges[i].odometry) expected.insert(static_cast<int>(i));
  EXPECT_EQ(seen, expected);
  EXPECT_EQ(support.loops(), expected.size());
  const std::size_t groups = support.clusters.size() - 3;
  for (std::size_t i = 1; i < groups; ++i)
    EXPECT_LE(support.clusters[i].size(), support.clusters[i - 1].size());
  const int first_copy = static_cast<int>(graph.edges.size()) - 3;
  for (std::size_t i = groups; i < groups + 3; ++i) {
    ASSERT_EQ(support.clusters[i].size(), 1u);
    EXPECT_GE(support.clusters[i][0], first_copy);
  }
  EXPECT_EQ(support.alone, std::count_if(support.clusters.begin(), support.clusters.end() - 3,
                                         [](const auto& cluster) { return cluster.size() == 1; }));
  // The true loops support each other, and the false ones hardly any.
  std::size_t largest_false = 0;
  for (const int edge : support.clusters.front())
    largest_false += graph.edges[edge].constraint >= static_cast<int>(walk.true_constraints);
  EXPECT_GE(support.clusters.front().size(), 40u);
  EXPECT_EQ(largest_false, 0u);
}

TEST(LoopSupportOfNothing, IsNone) {
  const auto packed = pack<SE2>(test::LoopedWalk<SE2>({.nodes = 10}).graph);
  for (const PackedGraph<SE2>& graph : {packed, PackedGraph<SE2>()}) {
    const LoopSupport support = support_loops(graph, OdometryChain<SE2>(graph), {});
    EXPECT_TRUE(support.clusters.empty());
    EXPECT_FALSE(support.scale_is_known);
    EXPECT_EQ(support.loops(), 0u);
  }
}

}  // namespace loop_clusters_test
}  // namespace placegraph
