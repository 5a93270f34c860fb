#include <gtest/gtest.h>
#include <placegraph/graph/loop_stage.h>

namespace placegraph {
namespace loop_stage_test {

TEST(LoopStage, IsReadBackFromItsNameAndTheModelOfTheLoop) {
  for (int i = 0; i <= kLoopStageCount; ++i) {  // with kManual
    const auto stage = static_cast<LoopStage>(i);
    // A relative pose stands behind every stage after geometry, and behind none before.
    const LoopModel model = stage < LoopStage::kDrift ? LoopModel::kNone : LoopModel::kPoints3d2d;
    EXPECT_EQ(loop_stage(to_string(stage), model), stage) << to_string(stage);
  }
}

TEST(LoopStage, CallsBothTestsByOdometryDrift) {
  EXPECT_STREQ(to_string(LoopStage::kReach), "drift");
  EXPECT_STREQ(to_string(LoopStage::kDrift), "drift");
  EXPECT_EQ(loop_stage("drift", LoopModel::kNone), LoopStage::kReach);
  for (const auto model : {LoopModel::kPoints3d2d, LoopModel::kEssential, LoopModel::kHomography})
    EXPECT_EQ(loop_stage("drift", model), LoopStage::kDrift);
}

TEST(LoopStage, OtherNamesAreNone) {
  for (const char* name : {"", "Drift", "reach", "unreachable", "accepted "})
    EXPECT_FALSE(loop_stage(name, LoopModel::kNone)) << name;
}

}  // namespace loop_stage_test
}  // namespace placegraph
