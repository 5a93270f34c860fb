#include <gtest/gtest.h>
#include <placegraph/backend/incremental_replay.h>
#include <placegraph/backend/pose_graph_optimizer.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>

#include "tests/support/growing_walk.h"

namespace placegraph {
namespace {

using test::GrowingWalk;

PoseGraphOptions tight() {
  PoseGraphOptions options;
  options.relative_decrease = 1e-15;
  return options;
}

template <class Group>
class IncrementalOptimizerOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(IncrementalOptimizerOf, Groups);

TYPED_TEST(IncrementalOptimizerOf, ReplayEndsAtTheOptimumOfTheWholeGraph) {
  const GrowingWalk<TypeParam> walk(60, 0.03, 1);
  const IncrementalReplay replay = optimize_incrementally(walk.graph);
  EXPECT_TRUE(replay.outcome) << replay.outcome.reason;
  const PoseGraphReport batch = optimize_pose_graph(replay.graph, tight());
  EXPECT_NEAR(replay.cost, batch.chi2_final, 1e-6 * batch.chi2_final);
  EXPECT_NEAR(chi2(replay.graph, RotationError::kLog), replay.cost, 1e-9 * replay.cost);
  EXPECT_EQ(replay.step_cpu_ms.size(), walk.graph.nodes.size());
  EXPECT_GE(replay.step_cpu_ms_max, replay.step_cpu_ms_p95);
  EXPECT_GT(replay.step_cpu_ms_mean, 0);
}

}  // namespace
}  // namespace placegraph
