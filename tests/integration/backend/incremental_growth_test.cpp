#include <gtest/gtest.h>
#include <placegraph/backend/incremental/incremental_replay.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/synthetic/graphs/graph_world.h>

#include "tests/support/data.h"

namespace placegraph {
namespace incremental_growth_test {

/// After every 100th step the incremental cost is held against the batch optimum of what has
/// arrived, found from the incremental poses; at the end within 1e-4.
void expect_near_the_batch(const PoseGraph& graph) {
  int compared = 0;
  const IncrementalReplay replay =
      optimize_incrementally(graph, {}, [&](int steps, const IncrementalOptimizer& optimizer) {
        if (steps % 100 != 0) return;
        PoseGraphOptions options;
        options.initialization = PoseGraphInitialization::kFile;
        const PoseGraphReport batch = optimize_pose_graph(optimizer.graph(), options);
        EXPECT_TRUE(batch.outcome) << batch.outcome.reason;
        // A walk without a loop yet costs nothing but rounding.
        EXPECT_LE(optimizer.cost(), 1.01 * batch.chi2_final + 1e-9) << "after step " << steps;
        ++compared;
      });
  EXPECT_TRUE(replay.outcome) << replay.outcome.reason;
  EXPECT_EQ(compared, static_cast<int>(graph.nodes.size()) / 100);
  const PoseGraphReport batch = optimize_pose_graph(graph, PoseGraphOptions());
  EXPECT_LE(replay.cost, (1 + 1e-4) * batch.chi2_final);
}

TEST(IncrementalGrowth, StaysWithinOnePercentOfTheBatchAfterEveryHundredthStepOfAWalk) {
  expect_near_the_batch(synthetic::make_manhattan_walk({.poses = 2000, .seed = 11}));
}

TEST(IncrementalGrowth, StaysWithinOnePercentOfTheBatchAfterEveryHundredthStepInSpace) {
  expect_near_the_batch(synthetic::make_grid_world({.poses = 600, .seed = 12}));
}

TEST(IncrementalGrowth, StaysWithinOnePercentOfTheBatchAfterEveryHundredthStepOfM3500) {
  PLACEGRAPH_DATA_OR_SKIP(path, "posegraphs/M3500.g2o");
  expect_near_the_batch(read_g2o(path));
}

}  // namespace incremental_growth_test
}  // namespace placegraph
