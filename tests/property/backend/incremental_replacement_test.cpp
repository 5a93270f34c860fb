#include <gtest/gtest.h>
#include <placegraph/backend/incremental/incremental_optimizer.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>

#include "tests/support/scenes/incremental_walk.h"

/// Constraints that are replaced and removed all the time, against the batch optimum.
namespace placegraph {
namespace incremental_replacement_test {

using test::IncrementalWalk;

constexpr double kNoise = 0.03;

template <class Group>
class IncrementalReplacement : public testing::Test {
 protected:
  /// The optimum of what the optimizer says its graph is.
  static void expect_batch_optimum(IncrementalOptimizer& optimizer) {
    const IncrementalStep step = optimizer.finish();
    ASSERT_TRUE(step.outcome) << step.outcome.reason;
    PoseGraphOptions tight;
    tight.relative_decrease = 1e-14;
    const double best = optimize_pose_graph(optimizer.graph(), tight).chi2_final;
    EXPECT_NEAR(optimizer.cost(), best, 1e-6 * best + 1e-9);
  }
};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(IncrementalReplacement, Groups);

TYPED_TEST(IncrementalReplacement, HundredsOfReplacedConstraintsEndAtTheBatchOptimum) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    IncrementalWalk<TypeParam> walk(60, kNoise, seed);
    IncrementalOptimizer optimizer;
    std::vector<int> alive, dead;
    const auto add = [&](const std::vector<PoseNode>& nodes,
                         const std::vector<Constraint>& constraints) {
      const IncrementalStep step = optimizer.add(nodes, constraints);
      ASSERT_TRUE(step.outcome) << step.outcome.reason;
      for (std::size_t i = 0; i < constraints.size(); ++i)
        alive.push_back(step.first_constraint + static_cast<int>(i));
    };
    for (const PoseNode& node : walk.graph.nodes) {
      std::vector<Constraint> constraints;
      for (const Constraint& c : walk.graph.constraints)
        if (std::get<RelativePoseConstraint>(c).to == node.id) constraints.push_back(c);
      add({node}, constraints);
    }
    const int nodes = static_cast<int>(walk.graph.nodes.size());
    for (int round = 0; round < 300; ++round) {
      // One goes, odometry as well as loops, one comes; now and then one comes back, or counts
      // half.
      const auto chosen = static_cast<std::size_t>(random.uniform() * alive.size());
      std::vector<ConstraintWeight> weights = {{alive[chosen], 0}};
      dead.push_back(alive[chosen]);
      alive.erase(alive.begin() + static_cast<std::ptrdiff_t>(chosen));
      if (round % 7 == 0 && !alive.empty()) weights.push_back({alive.front(), 0.5});
      if (round % 11 == 0) {
        weights.push_back({dead.front(), 2});
        alive.push_back(dead.front());
        dead.erase(dead.begin());
      }
      ASSERT_TRUE(optimizer.reweight(weights).outcome);
      const int from = static_cast<int>(random.uniform() * (nodes - 1));
      const int to = std::min(nodes - 1, from + 1 + static_cast<int>(random.uniform() * 8));
      add({}, {walk.measure(from, to, kNoise)});
      if (round % 60 == 59) this->expect_batch_optimum(optimizer);
    }
    EXPECT_EQ(optimizer.graph().constraints.size(), alive.size());
  }
}

TYPED_TEST(IncrementalReplacement, DeadConstraintsMakeNoStepDearer) {
  IncrementalWalk<TypeParam> walk(60, kNoise, 4);
  IncrementalOptimizer optimizer;
  optimizer.add(walk.graph.nodes, walk.graph.constraints);
  int current = optimizer.add({}, {walk.measure(5, 55, kNoise)}).first_constraint;
  int first = 0, last = 0;  // nodes eliminated anew by ten replacements
  for (int round = 0; round < 400; ++round) {
    const int next = optimizer.add({}, {walk.measure(5, 55, kNoise)}).first_constraint;
    const int refactored = optimizer.remove_constraint(current).nodes_refactored;
    current = next;
    if (round >= 10 && round < 20) first += refactored;
    if (round >= 390) last += refactored;
  }
  EXPECT_LE(last, 2 * first);
  this->expect_batch_optimum(optimizer);
}

TYPED_TEST(IncrementalReplacement, ANodeWithoutConstraintsStaysWhereItIs) {
  IncrementalWalk<TypeParam> walk(40, kNoise, 5);
  IncrementalOptimizer optimizer;
  optimizer.add(walk.graph.nodes, walk.graph.constraints);
  optimizer.finish();
  const NodeId lost = walk.graph.nodes[20].id;
  std::vector<ConstraintWeight> of_lost;
  for (std::size_t c = 0; c < walk.graph.constraints.size(); ++c) {
    const auto& relative = std::get<RelativePoseConstraint>(walk.graph.constraints[c]);
    if (relative.from == lost || relative.to == lost) of_lost.push_back({static_cast<int>(c), 0});
  }
  // The chain holds together without it.
  ASSERT_TRUE(optimizer.add({}, {walk.measure(19, 21, kNoise)}).outcome);
  const auto before = std::get<TypeParam>(*optimizer.pose(lost)).matrix();
  ASSERT_TRUE(optimizer.reweight(of_lost).outcome);
  ASSERT_TRUE(optimizer.add({}, {walk.measure(3, 33, kNoise)}).outcome);
  this->expect_batch_optimum(optimizer);
  EXPECT_EQ(std::get<TypeParam>(*optimizer.pose(lost)).matrix(), before);
  EXPECT_EQ(optimizer.covariance({lost}).norm(), 0);
  // It is put where a constraint says when one comes again.
  const RelativePoseConstraint back = walk.measure(19, 20, 0);
  ASSERT_TRUE(optimizer.add({}, {back}).outcome);
  this->expect_batch_optimum(optimizer);
  const auto T_19_20 = std::get<TypeParam>(*optimizer.pose(back.from)).inverse() *
                       std::get<TypeParam>(*optimizer.pose(lost));
  EXPECT_LT((T_19_20.inverse() * std::get<TypeParam>(back.T_from_to)).log().norm(), 1e-6);
}

}  // namespace incremental_replacement_test
}  // namespace placegraph
