#include <gtest/gtest.h>
#include <placegraph/eval/loops/loop_check.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <numbers>

#include "tests/support/trajectories.h"

namespace placegraph {
namespace loop_check_test {

using test::isometry;

LoopRecord loop(int query, int match, const Eigen::Isometry3d& T_match_query,
                bool accepted = true) {
  LoopRecord record;
  record.query_frame = FrameId(query);
  record.match_frame = FrameId(match);
  record.stage = accepted ? LoopStage::kAccepted : LoopStage::kSupport;
  record.T_match_query = SE3(T_match_query);
  return record;
}

TEST(LoopCheck, TellsTrueFromFalseConstraintsByTheTrueRelativePose) {
  const Trajectory truth = test::winding_drive(100);
  const Eigen::Isometry3d T_10_90 =
      truth.poses[10].T_world_body->inverse() * *truth.poses[90].T_world_body;
  const double degree = kRadPerDeg;
  const LoopCheck check =
      check_loops(truth,
                  {loop(90, 10, T_10_90), loop(90, 10, T_10_90 * isometry({0, 0, 0}, {0, 0.2, 0})),
                   loop(90, 10, T_10_90 * isometry({0, 6 * degree, 0}, {0, 0, 0})),
                   loop(90, 10, isometry({0, 0, 0}, {0, 0, 0}), false)},
                  {});
  ASSERT_EQ(check.loops.size(), 3u);
  EXPECT_EQ(check.correct, 1);
  EXPECT_EQ(check.wrong, 2);
  EXPECT_LT(check.loops[0].translation_error_m, 1e-9);
  EXPECT_NEAR(check.loops[1].translation_error_m, 0.2, 1e-9);
  EXPECT_NEAR(check.loops[2].rotation_error_deg, 6, 1e-9);
}

TEST(LoopCheck, CountsNeighboursAndFramesWithoutTruthApart) {
  Trajectory truth = test::winding_drive(100);
  truth.poses[5].T_world_body.reset();
  const Eigen::Isometry3d any = isometry({0, 0, 0}, {0, 0, 0});
  const LoopCheck check =
      check_loops(truth, {loop(40, 10, any), loop(90, 5, any), loop(500, 1, any)}, {});
  EXPECT_EQ(check.too_near, 1);
  EXPECT_EQ(check.unjudged, 2);
  EXPECT_TRUE(check.loops.empty());
}

TEST(LoopCheck, RefusesNegativeTolerances) {
  LoopCheckOptions options;
  options.max_translation_m = -1;
  EXPECT_THROW(check_loops({}, {}, options), ArgumentError);
}

}  // namespace loop_check_test
}  // namespace placegraph
