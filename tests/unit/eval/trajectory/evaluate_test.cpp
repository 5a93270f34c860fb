#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/trajectories.h"

namespace placegraph {
namespace evaluate_test {

using test::isometry;
using test::winding_drive;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

EvaluationOptions with(Alignment alignment) {
  EvaluationOptions options;
  options.alignment = alignment;
  options.segments.lengths_m = {20, 50};
  return options;
}

Trajectory scaled(Trajectory trajectory, double scale) {
  for (StampedPose& pose : trajectory.poses) pose.T_world_body->translation() *= scale;
  return trajectory;
}

Trajectory inverted(Trajectory trajectory) {
  for (StampedPose& pose : trajectory.poses) pose.T_world_body = pose.T_world_body->inverse();
  return trajectory;
}

TEST(Evaluate, FindsNoErrorInThePerfectEstimateAndDoesNotWarn) {
  const Trajectory truth = winding_drive(300);
  const EvaluationResult r = evaluate(truth, truth, with(Alignment::kNone));
  ASSERT_TRUE(r.outcome) << r.outcome.reason;
  EXPECT_EQ(r.frames, 300);
  EXPECT_EQ(r.posed, 300);
  EXPECT_EQ(r.coverage, 1);
  EXPECT_EQ(r.ape.error_m.max, 0);
  EXPECT_LT(r.segments.t_rel_percent, 1e-10);
  EXPECT_LT(r.rpe.rotation_deg.rmse, 1e-10);
  EXPECT_THAT(r.warnings, IsEmpty());
}

TEST(Evaluate, FindsTheScaleAndAppliesItBeforeEveryFigure) {
  const Trajectory truth = winding_drive(300);
  for (const Alignment alignment : {Alignment::kSim3, Alignment::kScale}) {
    const EvaluationResult r = evaluate(truth, scaled(truth, 0.25), with(alignment));
    ASSERT_TRUE(r.outcome);
    EXPECT_NEAR(r.alignment.scale, 4, 1e-9);
    EXPECT_LT(r.ape.error_m.max, 1e-9);
    EXPECT_LT(r.segments.t_rel_percent, 1e-8);
    EXPECT_LT(r.rpe.translation_m.rmse, 1e-9);
    EXPECT_THAT(r.warnings, IsEmpty());
  }
}

TEST(Evaluate, WarnsOfAWrongScaleWhereNoneIsFitted) {
  const Trajectory truth = winding_drive(300);
  for (const Alignment alignment : {Alignment::kNone, Alignment::kOrigin, Alignment::kSe3}) {
    const EvaluationResult r = evaluate(truth, scaled(truth, 0.5), with(alignment));
    EXPECT_THAT(r.warnings, Contains(HasSubstr("mis-scaled: a scale of 2.0000")));
    EXPECT_GT(r.segments.t_rel_percent, 45);  // half of every chord, which is most of the path
  }
}

TEST(Evaluate, WarnsOfInvertedPoses) {
  Random random(7);
  const Trajectory truth = winding_drive(300);
  const Trajectory estimate = test::drifting(truth, 0.02, 0.002, random);
  EXPECT_THAT(evaluate(truth, inverted(estimate), with(Alignment::kSe3)).warnings,
              Contains(HasSubstr("looks inverted")));
  EXPECT_THAT(evaluate(truth, estimate, with(Alignment::kSe3)).warnings, IsEmpty());
}

TEST(Evaluate, WarnsOfAShiftInTimeAndSaysByHowMuch) {
  Random random(8);
  const Trajectory truth = winding_drive(300);
  Trajectory estimate = test::drifting(truth, 0.01, 0.001, random);
  // Line i holds the pose of frame i - 3: the estimate is three frames late.
  for (std::size_t i = estimate.size(); i-- > 3;)
    estimate.poses[i].T_world_body = estimate.poses[i - 3].T_world_body;
  EXPECT_THAT(evaluate(truth, estimate, with(Alignment::kSe3)).warnings,
              Contains(HasSubstr("3 frames earlier")));
}

/// The quaternions of the poses with their four numbers moved by one place.
Trajectory reordered(Trajectory trajectory, bool scalar_to_front) {
  for (StampedPose& pose : trajectory.poses) {
    const Eigen::Quaterniond q(pose.T_world_body->linear());
    const Eigen::Quaterniond moved = scalar_to_front
                                         ? Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y())
                                         : Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w());
    pose.T_world_body->linear() = moved.toRotationMatrix();
  }
  return trajectory;
}

TEST(Evaluate, NamesQuaternionsOfTheOtherOrder) {
  Random random(9);
  const Trajectory truth = winding_drive(300);
  const Trajectory estimate = test::drifting(truth, 0.02, 0.002, random);
  const auto warnings = [&](const Trajectory& a, const Trajectory& b) {
    return evaluate(a, b, with(Alignment::kSe3)).warnings;
  };
  // Written w first and read w last: the numbers read as x y z w are w x y z.
  EXPECT_THAT(warnings(truth, reordered(estimate, true)),
              Contains(HasSubstr("the estimate's quaternions seem to have w first, not last")));
  EXPECT_THAT(warnings(truth, reordered(estimate, false)),
              Contains(HasSubstr("the estimate's quaternions seem to have w last, not first")));
  EXPECT_THAT(warnings(reordered(truth, true), estimate),
              Contains(HasSubstr("the ground truth's quaternions seem to have w first")));
}

TEST(Evaluate, NamesTheAxesOfAnotherSensor) {
  Random random(10);
  const Trajectory truth = winding_drive(300);
  Trajectory estimate = test::drifting(truth, 0.02, 0.002, random);
  Eigen::Matrix3d R_cam_body;  // x right, y down, z forward to x forward, y left, z up
  R_cam_body << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  for (StampedPose& pose : estimate.poses)
    pose.T_world_body->linear() = pose.T_world_body->linear() * R_cam_body;
  EXPECT_THAT(evaluate(truth, estimate, with(Alignment::kSe3)).warnings,
              Contains(HasSubstr("axes are rotated by 120 deg")));
}

TEST(Evaluate, NamesTrajectoriesThatNeverRotateOrNeverMove) {
  const Trajectory truth = winding_drive(300);
  Trajectory still = truth, stuck = truth;
  for (StampedPose& pose : still.poses) pose.T_world_body->linear().setIdentity();
  EXPECT_THAT(evaluate(still, truth, with(Alignment::kSe3)).warnings,
              Contains(HasSubstr("the ground truth never turns")));
  EXPECT_THAT(evaluate(truth, still, with(Alignment::kSe3)).warnings,
              Contains(HasSubstr("the estimate never turns")));
  for (StampedPose& pose : stuck.poses) pose.T_world_body = truth.poses[0].T_world_body;
  EXPECT_THAT(evaluate(truth, stuck, with(Alignment::kSe3)).outcome.reason,
              HasSubstr("the estimate never moves"));
  EXPECT_THAT(evaluate(stuck, truth, with(Alignment::kSe3)).outcome.reason,
              HasSubstr("the ground truth never moves"));
}

TEST(Evaluate, GivesWhatPositionsAloneAllow) {
  Random random(11);
  Trajectory truth = winding_drive(300);
  const Trajectory estimate = test::drifting(truth, 0.02, 0.002, random);
  const double rmse_m = evaluate(truth, estimate, with(Alignment::kSim3)).ape.error_m.rmse;
  for (StampedPose& pose : truth.poses) pose.T_world_body->linear().setIdentity();
  truth.has_orientation = false;
  const EvaluationResult r = evaluate(truth, estimate, with(Alignment::kSim3));
  ASSERT_TRUE(r.outcome) << r.outcome.reason;
  EXPECT_EQ(r.ape.error_m.rmse, rmse_m);
  EXPECT_THAT(r.warnings, Contains(HasSubstr("no RPE: RPE needs orientations")));
  EXPECT_THAT(r.warnings, Contains(HasSubstr("no t_rel and r_rel: ")));
  for (const Metric& metric : metrics(r)) {
    const bool of_motion =
        metric.key.starts_with("rpe") || metric.key.starts_with("are") ||
        metric.key.find("_rel_") != std::string::npos;
    EXPECT_EQ(metric.value.has_value(), !of_motion) << metric.key;
  }
  EXPECT_THAT(evaluate(truth, estimate, with(Alignment::kOrigin)).outcome.reason,
              HasSubstr("align origin needs orientations"));
}

TEST(Evaluate, NamesTimesOfAnotherUnit) {
  Trajectory truth = winding_drive(300);
  for (StampedPose& pose : truth.poses) pose.stamp_ns *= 1000;
  EXPECT_THAT(evaluate(truth, truth, with(Alignment::kSe3)).warnings,
              Contains(HasSubstr("the ground truth has a pose every 100 s (0.01 Hz)")));
}

TEST(Evaluate, ListsLostFramesAndCountsOnlyPosedOnes) {
  const Trajectory truth = winding_drive(100, 1, false);
  Trajectory estimate = truth;
  for (const std::size_t i : {std::size_t{5}, std::size_t{50}, std::size_t{99}})
    estimate.poses[i].T_world_body.reset();
  const EvaluationResult r = evaluate(truth, estimate, with(Alignment::kSe3));
  EXPECT_EQ(r.posed, 97);
  EXPECT_DOUBLE_EQ(r.coverage, 0.97);
  EXPECT_EQ(r.lost_frames, (std::vector<int>{5, 50, 99}));
  EXPECT_EQ(r.rpe.translation_m.count, 99 - 5);
}

TEST(Evaluate, WarnsThatAClipIsTooShortForItsLengthsAndKeepsTheOtherFigures) {
  const Trajectory truth = winding_drive(40);
  const EvaluationResult r = evaluate(truth, truth, {});
  ASSERT_TRUE(r.outcome);
  EXPECT_FALSE(r.segments.outcome);
  EXPECT_TRUE(r.ape.outcome);
  EXPECT_THAT(r.warnings, Contains(HasSubstr("too short for segments of 100 m")));
  for (const Metric& metric : metrics(r))
    EXPECT_EQ(metric.value.has_value(), metric.name != "t_rel" && metric.name != "r_rel")
        << metric.key;
}

TEST(Evaluate, GivesTheErrorOfAStraightLineThoughItsRollIsFree) {
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 50; ++i) poses.push_back(isometry({0, 0, 0}, {0, 0, i * 1.0}));
  const Trajectory truth = test::trajectory_of(poses);
  const EvaluationResult r = evaluate(truth, truth, with(Alignment::kSe3));
  ASSERT_TRUE(r.outcome);
  EXPECT_LT(r.ape.error_m.rmse, 1e-9);
  EXPECT_THAT(r.warnings, Contains(HasSubstr("lie on a line")));
}

TEST(Evaluate, HasNoFiguresWhereTheAssociationWasRefused) {
  const Trajectory truth = winding_drive(20, 1, false);
  Trajectory shorter = truth;
  shorter.poses.pop_back();
  const EvaluationResult r = evaluate(truth, shorter, {});
  EXPECT_FALSE(r.outcome);
  for (const Metric& metric : metrics(r)) EXPECT_FALSE(metric.value) << metric.key;
}

TEST(Evaluate, RefusesTwoPosesForARigidFit) {
  const Trajectory truth = winding_drive(2);
  EXPECT_EQ(evaluate(truth, truth, with(Alignment::kSe3)).outcome.code, Outcome::Code::kTooFewData);
  EXPECT_TRUE(evaluate(truth, truth, with(Alignment::kOrigin)).outcome);
}

TEST(Average, IsOverSequencesAndPooledOverSegments) {
  EvaluationResult a, b, failed;
  a.outcome = b.outcome = a.segments.outcome = b.segments.outcome = Outcome::ok();
  a.segments.t_rel_percent = 1;
  a.segments.segments.assign(1, {.t_percent = 1, .r_deg_per_100m = 4});
  b.segments.t_rel_percent = 2;
  b.segments.segments.assign(3, {.t_percent = 2, .r_deg_per_100m = 8});
  const AverageResult mean = average({a, b});
  EXPECT_EQ(mean.sequences, 2);
  EXPECT_EQ(mean.segments, 4);
  EXPECT_DOUBLE_EQ(*mean.pooled_t_rel.value, 7.0 / 4);
  EXPECT_DOUBLE_EQ(*mean.pooled_r_rel.value, 28.0 / 4);
  for (const Metric& metric : mean.means) {
    if (metric.key == "t_rel_percent") {
      EXPECT_DOUBLE_EQ(*metric.value, 1.5);
    }
    if (metric.key == "ate_rmse_m") {
      EXPECT_FALSE(metric.value);
    }
  }
  // A sequence without figures leaves no mean over all, and is counted.
  const AverageResult partial = average({a, b, failed});
  EXPECT_EQ(partial.failed, 1);
  EXPECT_FALSE(partial.pooled_t_rel.value);
  for (const Metric& metric : partial.means) EXPECT_FALSE(metric.value) << metric.key;
  for (const Metric& metric : partial.means_of_rest)
    if (metric.key == "t_rel_percent") {
      EXPECT_DOUBLE_EQ(*metric.value, 1.5);
    }
}

TEST(EvaluationOptions, NameTheFieldThatIsOutOfRange) {
  EvaluationOptions options;
  options.segments.step = 0;
  try {
    options.check();
    FAIL() << "step 0 was accepted";
  } catch (const ArgumentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("segments.step"));
  }
}

}  // namespace evaluate_test
}  // namespace placegraph
