#include <gtest/gtest.h>
#include <placegraph/backend/robust/loop_clusters.h>
#include <placegraph/backend/robust/loop_leverage.h>
#include <placegraph/backend/robust/pcm.h>
#include <placegraph/graph/core/chi_squared.h>

#include <algorithm>

#include "tests/support/scenes/looped_walk.h"

namespace placegraph {
namespace pcm_test {

using test::LoopedWalk;

/// A straight line of `n` poses one metre apart, information 100 of everything.
PoseGraph line(int n) {
  PoseGraph graph;
  for (int i = 0; i < n; ++i) graph.nodes.push_back({NodeId(i), SE2(i, 0, 0), false});
  for (int i = 1; i < n; ++i)
    graph.constraints.emplace_back(RelativePoseConstraint{NodeId(i - 1),
                                                          NodeId(i),
                                                          SE2(1, 0, 0),
                                                          Information::Identity(3, 3) * 100.0,
                                                          ConstraintSource::kOdometry,
                                                          {}});
  return graph;
}

void add_loop(PoseGraph& graph, int from, int to, const SE2& T_from_to) {
  graph.constraints.emplace_back(RelativePoseConstraint{NodeId(from),
                                                        NodeId(to),
                                                        T_from_to,
                                                        Information::Identity(3, 3) * 100.0,
                                                        ConstraintSource::kLoop,
                                                        {}});
}

TEST(OdometryChain, AddsUpMotionAndVarianceAlongALine) {
  const auto packed = pack<SE2>(line(11));
  const OdometryChain<SE2> chain(packed);
  EXPECT_EQ(chain.runs(), 1);
  EXPECT_NEAR(chain.pose(10).translation().x(), 10, 1e-12);
  // Seen from node 0: angles turn about where they were measured, at x = 1 .. 10.
  const Eigen::Matrix3d covariance = chain.covariance(0, 10);
  EXPECT_NEAR(covariance(0, 0), 0.1, 1e-9);
  EXPECT_NEAR(covariance(2, 2), 0.1, 1e-9);
  EXPECT_NEAR(covariance(1, 1), 0.1 + 0.01 * 385, 1e-9);  // 1 + 4 + ... + 100 = 385
  EXPECT_TRUE(chain.covariance(7, 3).isApprox(chain.covariance(3, 7)));
}

TEST(OdometryChain, PartsWhereOdometryIsMissing) {
  PoseGraph graph = line(6);
  std::get<RelativePoseConstraint>(graph.constraints[2]).source = ConstraintSource::kOther;
  const auto packed = pack<SE2>(graph);
  const OdometryChain<SE2> chain(packed);
  EXPECT_EQ(chain.runs(), 2);
  EXPECT_EQ(chain.run(2), chain.run(0));
  EXPECT_NE(chain.run(3), chain.run(2));
  EXPECT_EQ(chain.position(5), 2);
}

TEST(LoopPairs, MisclosureOfARingIsThatOfItsMeasurements) {
  PoseGraph graph = line(20);
  add_loop(graph, 2, 12, SE2(0.0, 0, 0));
  add_loop(graph, 13, 3, SE2(-0.3, 0, 0));  // turned round: 3 -> 13 is +0.3
  const auto packed = pack<SE2>(graph);
  const OdometryChain<SE2> chain(packed);
  const auto loops = loops_on_chain(packed, chain);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(loops[1].from, 3);
  // One metre on at both ends: 0.3 m are left, of four measurements with 0.01 m^2 each.
  const double chi2 = ring_misclosure(loops[0], loops[1], chain).chi2;
  EXPECT_NEAR(chi2, 0.3 * 0.3 / 0.04, 1e-9);
}

TEST(LoopPairs, DriftIsJudgedAgainstTheWholeOdometryOfTheLoop) {
  PoseGraph graph = line(20);
  add_loop(graph, 0, 8, SE2(8.6, 0, 0));
  const auto packed = pack<SE2>(graph);
  const OdometryChain<SE2> chain(packed);
  EXPECT_NEAR(drift_misclosure(loops_on_chain(packed, chain)[0], chain).chi2, 0.36 / 0.09, 1e-9);
}

TEST(PairwiseConsistency, KeepsTheLoopsThatAgreeAndDropsTheRest) {
  PoseGraph graph = line(40);
  for (int i = 0; i < 6; ++i) add_loop(graph, i, 30 + i, SE2(0, 0, 0));
  add_loop(graph, 4, 20, SE2(0, 5, 1));
  add_loop(graph, 10, 38, SE2(-4, 0, 2));
  const auto packed = pack<SE2>(graph);
  const OdometryChain<SE2> chain(packed);
  const auto sets = consistent_loops(packed, chain, chi_squared_quantile(0.99, 3));
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_EQ(sets[0], (std::vector<int>{39, 40, 41, 42, 43, 44}));
}

TEST(LoopSupport, FindsTheNoiseWhateverTheInformationClaims) {
  for (const double claimed : {0.002, 0.02, 0.2}) {
    const LoopedWalk<SE2> walk({.claimed = claimed, .false_loops = 100});
    const auto packed = pack<SE2>(walk.graph);
    const LoopSupport support = support_loops(packed, OdometryChain<SE2>(packed), {});
    const double expected = 0.02 * 0.02 / (claimed * claimed);
    // The rings share odometry and loops: their mean is good to some ten per cent.
    EXPECT_NEAR(support.noise_scale, expected, 0.3 * expected);
    EXPECT_GT(support.alone, 60);
  }
}

TEST(LoopLeverage, IsTheRiseOfTheCostWhenTheLoopIsAdded) {
  // Along a line all is linear: eight steps of 0.01 m^2 and the loop's own.
  PoseGraph graph = line(20);
  add_loop(graph, 0, 8, SE2(8.6, 0, 0));
  auto packed = pack<SE2>(graph);
  packed.edges.back().weight = 0;
  const auto cost = cost_of_adding(packed, {19}, RotationError::kLog, 1e9);
  ASSERT_EQ(cost.size(), 1u);
  EXPECT_NEAR(cost[0], 0.36 / 0.09, 1e-9);
}

TEST(LoopLeverage, SamplesTellOnlyWhatIsFarAbove) {
  const LoopedWalk<SE3> walk({.nodes = 200, .false_loops = 150});
  auto packed = pack<SE3>(walk.graph);
  for (std::size_t i = 0; i < packed.poses.size(); ++i) packed.poses[i] = walk.truth[i];
  std::vector<int> loops;
  for (std::size_t i = 0; i < packed.edges.size(); ++i)
    if (!packed.edges[i].odometry) {
      packed.edges[i].weight = packed.edges[i].constraint % 3 == 0 ? 0 : 1;
      if (packed.edges[i].weight == 0) loops.push_back(static_cast<int>(i));
    }
  for (int i = 0; i < 60; ++i) loops.push_back(loops[i]);
  ASSERT_GE(loops.size(), 100u);
  const auto exact = cost_of_adding(packed, loops, RotationError::kLog, 1e12);
  const auto rough = cost_of_adding(packed, loops, RotationError::kLog, 30.0);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (exact[i] <= 30)
      EXPECT_NEAR(rough[i], exact[i], 1e-9 * exact[i]);
    else
      EXPECT_GT(rough[i], 30);
  }
}

TEST(Pcm, KeepsManyCopiesOfALoopTogether) {
  PoseGraph graph = line(40);
  for (int i = 0; i < 5000; ++i) add_loop(graph, 2, 30, SE2(28, 0, 0));
  for (int i = 0; i < 3; ++i) add_loop(graph, 4 + i, 31, SE2(10, 5, 1));
  const auto packed = pack<SE2>(graph);
  const OdometryChain<SE2> chain(packed);
  const auto sets = consistent_loops(packed, chain, chi_squared_quantile(0.95, 3), 1'000'000);
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_EQ(sets[0].size(), 5000u);
}

TEST(NeighbouringPairs, AreAsManyAsTheNeighboursAllow) {
  PoseGraph graph = line(40);
  constexpr int kCopies = 20'000, kNeighbours = 5;
  for (int i = 0; i < kCopies; ++i) add_loop(graph, 2, 30, SE2(28, 0, 0));
  add_loop(graph, 3, 31, SE2(28, 0, 0));
  const auto packed = pack<SE2>(graph);
  const OdometryChain<SE2> chain(packed);
  const auto loops = loops_on_chain(packed, chain);
  const auto pairs = neighbouring_pairs(loops, chain, 10, kNeighbours);
  EXPECT_LE(pairs.size(), static_cast<std::size_t>(kNeighbours) * loops.size());
  EXPECT_GE(pairs.size(), loops.size());
  const bool other = std::ranges::any_of(pairs, [&](const LoopPair& pair) {
    return loops[pair.b].from == 3 || loops[pair.a].from == 3;
  });
  EXPECT_TRUE(other);
}

}  // namespace pcm_test
}  // namespace placegraph
