#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/association/pairing.h>

#include "tests/support/trajectories.h"

namespace placegraph {
namespace pairing_test {

using test::winding_drive;
using ::testing::HasSubstr;

Trajectory without(Trajectory trajectory, std::size_t index) {
  trajectory.poses.erase(trajectory.poses.begin() + static_cast<std::ptrdiff_t>(index));
  return trajectory;
}

Trajectory later(Trajectory trajectory, std::int64_t by_ns) {
  for (StampedPose& pose : trajectory.poses) pose.stamp_ns += by_ns;
  return trajectory;
}

TEST(Pairing, GoesByTimeWhereBothHaveTimes) {
  const Trajectory truth = winding_drive(20);
  const PairingResult result =
      pair_trajectories(truth, without(later(truth, 5'000'000), 7), Association::kAuto, {});
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_EQ(result.association, Association::kTime);
  EXPECT_EQ(result.truth_frames, 20);
  EXPECT_EQ(result.posed, 19);
  EXPECT_FALSE(result.pairs[7].T_world_estimate);
  EXPECT_EQ(result.truth_frames, static_cast<int>(result.pairs.size()));
}

TEST(Pairing, GoesByIndexWhereNeitherHasTimes) {
  Trajectory truth = winding_drive(20, 1, false), estimate = truth;
  estimate.poses[3].T_world_body.reset();
  const PairingResult result = pair_trajectories(truth, estimate, Association::kAuto, {});
  ASSERT_TRUE(result.outcome);
  EXPECT_EQ(result.association, Association::kIndex);
  EXPECT_EQ(result.posed, 19);
  EXPECT_FALSE(result.has_times);
}

TEST(Pairing, RefusesDifferentLengthsWithoutTimes) {
  const Trajectory truth = winding_drive(20, 1, false);
  const PairingResult result = pair_trajectories(truth, without(truth, 0), Association::kAuto, {});
  EXPECT_EQ(result.outcome.code, Outcome::Code::kInconsistent);
  EXPECT_THAT(result.outcome.reason, HasSubstr("the ground truth has 20, the estimate 19"));
}

TEST(Pairing, RefusesTimesOnOneSideUnlessAssociatedByIndex) {
  const Trajectory truth = winding_drive(20, 1, false), estimate = winding_drive(20);
  EXPECT_THAT(pair_trajectories(truth, estimate, Association::kAuto, {}).outcome.reason,
              HasSubstr("only the estimate has times"));
  EXPECT_THAT(pair_trajectories(truth, estimate, Association::kTime, {}).outcome.reason,
              HasSubstr("the ground truth has none"));
  EXPECT_TRUE(pair_trajectories(truth, estimate, Association::kIndex, {}).outcome);
}

TEST(Pairing, RefusesStampsThatDoNotOverlap) {
  const Trajectory truth = winding_drive(20);
  const PairingResult result =
      pair_trajectories(truth, later(truth, 1'000'000'000'000), Association::kAuto, {});
  EXPECT_EQ(result.outcome.code, Outcome::Code::kInconsistent);
  EXPECT_THAT(result.outcome.reason, HasSubstr("do not overlap"));
}

TEST(Pairing, AppliesTheOffsetToTheEstimate) {
  const Trajectory truth = winding_drive(20);
  AssociationOptions options;
  options.offset_s = -1000;
  const PairingResult result =
      pair_trajectories(truth, later(truth, 1'000'000'000'000), Association::kTime, options);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_EQ(result.posed, 20);
}

TEST(Pairing, SaysThatStampsAreNeverNearEnough) {
  const Trajectory truth = winding_drive(20);
  const PairingResult result =
      pair_trajectories(truth, later(truth, 50'000'000), Association::kTime, {});
  EXPECT_EQ(result.outcome.code, Outcome::Code::kInconsistent);
  EXPECT_EQ(result.outcome.reason,
            "most poses find no partner within 0.02 s: 0 pairs of 19 poses of the ground truth and "
            "19 of the estimate in the time that both cover; -0.05 s on the estimate's stamps would "
            "pair 20 (--offset -0.05)");
}

TEST(Pairing, ThinsADenserGroundTruthAndKeepsHolesAsLostFrames) {
  Trajectory truth = winding_drive(200);
  for (std::size_t i = 0; i < truth.size(); ++i)
    truth.poses[i].stamp_ns = static_cast<std::int64_t>(i) * 10'000'000;  // 100 Hz
  Trajectory estimate;  // 10 Hz; two lines in the middle and the last three are missing
  for (std::size_t i = 0; i < truth.size(); i += 10)
    if (i != 100 && i != 110 && i < 170) estimate.poses.push_back(truth.poses[i]);
  const PairingResult result = pair_trajectories(truth, estimate, Association::kTime, {0.004, 0});
  ASSERT_TRUE(result.outcome);
  EXPECT_EQ(result.truth_frames, 200);
  EXPECT_EQ(result.posed, 15);
  ASSERT_EQ(result.pairs.size(), 20u);
  for (std::size_t k = 0; k < 20; ++k) {
    EXPECT_EQ(result.pairs[k].frame, static_cast<int>(10 * k));
    EXPECT_EQ(result.pairs[k].T_world_estimate.has_value(), k != 10 && k != 11 && k < 17);
  }
}

TEST(Pairing, LeavesOutLinesTheGroundTruthItselfHasLost) {
  Trajectory truth = winding_drive(10, 1, false);
  const Trajectory estimate = truth;
  truth.poses[4].T_world_body.reset();
  const PairingResult result = pair_trajectories(truth, estimate, Association::kAuto, {});
  EXPECT_EQ(result.truth_frames, 9);
  EXPECT_EQ(result.pairs[4].frame, 5);
}

TEST(Pairing, CountsAsLostOnlyWhatIsFarFromEveryEstimate) {
  // The truth at 12 Hz, the estimate at 10 Hz without a hole: no frame is lost.
  Trajectory truth = winding_drive(96), estimate = winding_drive(80);
  for (std::size_t i = 0; i < truth.size(); ++i)
    truth.poses[i].stamp_ns = static_cast<std::int64_t>(i) * 1'000'000'000 / 12;
  for (std::size_t i = 0; i < estimate.size(); ++i)
    estimate.poses[i].stamp_ns = static_cast<std::int64_t>(i) * 100'000'000;
  const PairingResult whole = pair_trajectories(truth, estimate, Association::kTime, {});
  EXPECT_EQ(whole.posed, static_cast<int>(whole.pairs.size()));
  EXPECT_EQ(whole.estimate_frames, 80);
  EXPECT_EQ(whole.estimate_without_truth, 80 - whole.posed);
  EXPECT_GT(whole.estimate_without_truth, 0);
  estimate.poses.erase(estimate.poses.begin() + 40, estimate.poses.begin() + 60);  // two seconds
  const PairingResult hole = pair_trajectories(truth, estimate, Association::kTime, {});
  EXPECT_NEAR(static_cast<double>(hole.pairs.size()) - hole.posed, 2 * 12, 2);
}

TEST(Pairing, GoesByTheNumbersOfFramesWhereAFileHasThem) {
  const Trajectory truth = winding_drive(60, 1, false);
  Trajectory estimate = truth;
  estimate.numbered = true;
  std::erase_if(estimate.poses, [](const StampedPose& pose) { return pose.stamp_ns % 5 == 2; });
  const PairingResult result = pair_trajectories(truth, estimate, Association::kAuto, {});
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_EQ(result.association, Association::kIndex);
  EXPECT_EQ(result.pairs.size(), 60u);
  EXPECT_EQ(result.posed, 48);
  EXPECT_FALSE(result.pairs[7].T_world_estimate);
  EXPECT_EQ(result.pairs[8].T_world_estimate->matrix(), truth.poses[8].T_world_body->matrix());
}

TEST(Pairing, NamesAnotherUnitOrClockWhereStampsDoNotOverlap) {
  const Trajectory truth = winding_drive(20);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate.poses) pose.stamp_ns = 1'000'000'000'000 + 1000 * pose.stamp_ns;
  EXPECT_THAT(pair_trajectories(truth, estimate, Association::kTime, {}).outcome.reason,
              HasSubstr("in milliseconds"));
  EXPECT_THAT(pair_trajectories(truth, later(truth, 1'000'000'000'000), Association::kTime, {})
                  .outcome.reason,
              HasSubstr("of another clock"));
}

}  // namespace pairing_test
}  // namespace placegraph
