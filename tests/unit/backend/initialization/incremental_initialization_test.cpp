#include <gtest/gtest.h>
#include <placegraph/backend/initialization/incremental_initialization.h>
#include <placegraph/backend/solver/local_solver.h>

#include <algorithm>

#include "tests/support/scenes/incremental_walk.h"
#include "tests/support/scenes/pose_walk.h"

namespace placegraph {
namespace incremental_initialization_test {

using test::IncrementalWalk;

constexpr double kUnlimited = 1e6;

template <class Group>
class ReplayedStartOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(ReplayedStartOf, Groups);

TYPED_TEST(ReplayedStartOf, IsExactWhereTheMeasurementsAgree) {
  const IncrementalWalk<TypeParam> walk(60, 0, 1);
  PackedGraph<TypeParam> graph = pack<TypeParam>(walk.graph);
  ASSERT_TRUE(initialize_incrementally(graph, RotationError::kLog, kUnlimited));
  for (std::size_t i = 0; i < walk.truth.size(); ++i)
    EXPECT_LT(test::difference(graph.poses[i], walk.truth[i]), 1e-6);
}

TYPED_TEST(ReplayedStartOf, EndsByTheMinimumWithItsWeightsWhateverTheOrderOfTheNodes) {
  const IncrementalWalk<TypeParam> walk(60, 0.03, 2);
  PoseGraph shuffled = walk.graph;
  shuffled.nodes[0].fixed = true;
  std::reverse(shuffled.nodes.begin() + 5, shuffled.nodes.end());
  std::rotate(shuffled.nodes.begin(), shuffled.nodes.begin() + 17, shuffled.nodes.end());
  for (const PoseGraph& given : {walk.graph, shuffled}) {
    PackedGraph<TypeParam> graph = pack<TypeParam>(given);
    for (std::size_t i = 0; i < graph.edges.size(); i += 7) graph.edges[i].weight = 0.25;
    ASSERT_TRUE(initialize_incrementally(graph, RotationError::kLog, kUnlimited));
    const double replayed = robust_cost(graph, RotationError::kLog);
    LocalSolver<TypeParam> solver({});
    const LocalSolution solution = solver.solve(graph);
    ASSERT_TRUE(solution.outcome) << solution.outcome.reason;
    // Steps iterate to a predicted excess of 5e-3.
    EXPECT_LT(replayed, 1.02 * solution.cost_final);
  }
}

TYPED_TEST(ReplayedStartOf, LeavesHeldNodesWhereTheyAre) {
  const IncrementalWalk<TypeParam> walk(40, 0.03, 3);
  PoseGraph held = walk.graph;
  for (const int i : {3, 30}) {
    held.nodes[i].fixed = true;
    held.nodes[i].T_world_node = walk.truth[i];
  }
  PackedGraph<TypeParam> graph = pack<TypeParam>(held);
  ASSERT_TRUE(initialize_incrementally(graph, RotationError::kLog, kUnlimited));
  for (const int i : {3, 30}) EXPECT_EQ(graph.poses[i].matrix(), walk.truth[i].matrix());
}

TYPED_TEST(ReplayedStartOf, LeavesAllAsItWasWhereItCostsMoreThanGranted) {
  const IncrementalWalk<TypeParam> walk(60, 0.03, 4);
  PackedGraph<TypeParam> graph = pack<TypeParam>(walk.graph);
  const auto before = graph.poses;
  EXPECT_FALSE(initialize_incrementally(graph, RotationError::kLog, 0.5));
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(graph.poses[i].matrix(), before[i].matrix());
}

TYPED_TEST(ReplayedStartOf, LeavesAllAsItWasWhereNoCostCanBeComputed) {
  IncrementalWalk<TypeParam> walk(20, 0, 5);
  auto far = walk.measure(2, 12, 0);
  typename TypeParam::Tangent xi = TypeParam::Tangent::Zero();
  xi[0] = 1e200;
  far.T_from_to = TypeParam::exp(xi);
  walk.graph.constraints.emplace_back(far);
  PackedGraph<TypeParam> graph = pack<TypeParam>(walk.graph);
  const auto before = graph.poses;
  EXPECT_FALSE(initialize_incrementally(graph, RotationError::kLog, kUnlimited));
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(graph.poses[i].matrix(), before[i].matrix());
}

}  // namespace incremental_initialization_test
}  // namespace placegraph
