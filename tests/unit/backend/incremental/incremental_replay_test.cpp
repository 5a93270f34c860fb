#include <gtest/gtest.h>
#include <placegraph/backend/incremental/incremental_replay.h>

#include <algorithm>

#include "tests/support/message_of.h"
#include "tests/support/packed_graphs.h"

namespace placegraph {
namespace incremental_replay_test {

TEST(IncrementalReplay, AddsNodesByTheirIdsInWhateverOrderTheyAre) {
  const test::Walk<SE2> walk(20, 0.03);
  PoseGraph shuffled = walk.graph;
  Random random(1);
  test::shuffle(shuffled.nodes, random);
  const IncrementalReplay expected = optimize_incrementally(walk.graph);
  const IncrementalReplay replay = optimize_incrementally(shuffled);
  EXPECT_EQ(replay.cost, expected.cost);
  ASSERT_EQ(replay.graph.nodes.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    const NodeId id = replay.graph.nodes[i].id;
    EXPECT_EQ(id, shuffled.nodes[i].id);
    const auto& pose = expected.graph.nodes[static_cast<std::size_t>(id.value() - 10)];
    EXPECT_EQ(std::get<SE2>(replay.graph.nodes[i].T_world_node).matrix(),
              std::get<SE2>(pose.T_world_node).matrix());
  }
}

TEST(IncrementalReplay, ShowsEveryStepWithTheConstraintsSoFar) {
  test::Walk<SE3> walk(12, 0.03);
  PositionConstraint position;
  position.node = NodeId(14);
  walk.graph.constraints.emplace_back(position);
  int steps = 0;
  const auto watch = [&](int done, const IncrementalOptimizer& optimizer) {
    EXPECT_EQ(done, ++steps);
    const PoseGraph graph = optimizer.graph();
    EXPECT_EQ(graph.nodes.size(), static_cast<std::size_t>(done));
    const NodeId last(9 + done);
    const auto known = std::count_if(
        walk.graph.constraints.begin(), walk.graph.constraints.end(), [&](const Constraint& c) {
          if (const auto* relative = std::get_if<RelativePoseConstraint>(&c))
            return std::max(relative->from, relative->to) <= last;
          return NodeId(14) <= last;
        });
    EXPECT_EQ(static_cast<std::ptrdiff_t>(graph.constraints.size()), known) << "step " << done;
  };
  const IncrementalReplay replay = optimize_incrementally(walk.graph, {}, watch);
  EXPECT_EQ(steps, 12);
  EXPECT_EQ(replay.step_cpu_ms.size(), 12u);
}

TEST(IncrementalReplay, LeavesFixedNodesAlone) {
  test::Walk<SE2> walk(15, 0.05);
  walk.graph.nodes[4].fixed = walk.graph.nodes[9].fixed = true;
  const IncrementalReplay replay = optimize_incrementally(walk.graph);
  EXPECT_TRUE(replay.outcome) << replay.outcome.reason;
  for (const int i : {4, 9})
    EXPECT_EQ(walk.pose(replay.graph, i).matrix(), walk.pose(walk.graph, i).matrix());
  EXPECT_GT((walk.pose(replay.graph, 6).log() - walk.pose(walk.graph, 6).log()).norm(), 1e-3);
}

TEST(IncrementalReplay, SumsUpItsSteps) {
  const IncrementalReplay replay = optimize_incrementally(test::Walk<SE2>(30, 0.05).graph);
  std::vector<double> sorted = replay.step_cpu_ms;
  std::sort(sorted.begin(), sorted.end());
  double sum = 0;
  for (const double ms : sorted) sum += ms;
  EXPECT_NEAR(replay.step_cpu_ms_mean, sum / 30, 1e-12 * sum);
  EXPECT_EQ(replay.step_cpu_ms_max, sorted[29]);
  EXPECT_EQ(replay.step_cpu_ms_p95, sorted[28]) << "28.5 of 30 steps were as quick";
}

TEST(IncrementalReplay, OfNothingIsNothingAndOfABrokenGraphAnError) {
  const IncrementalReplay replay = optimize_incrementally(PoseGraph());
  EXPECT_TRUE(replay.outcome);
  EXPECT_EQ(replay.cost, 0);
  EXPECT_TRUE(replay.step_cpu_ms.empty());
  PoseGraph graph = test::Walk<SE2>(5, 0).graph;
  graph.nodes[3].id = graph.nodes[1].id;
  const std::string message =
      test::message_of<ArgumentError>([&] { (void)optimize_incrementally(graph); });
  EXPECT_NE(message.find("node 11"), std::string::npos) << message;
}

}  // namespace incremental_replay_test
}  // namespace placegraph
