#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/alignment/alignment.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/eval/alignment/vertical.h>
#include <placegraph/graph/core/angle.h>

#include <numbers>

#include "tests/support/trajectories.h"

namespace placegraph {
namespace alignment_test {

using test::isometry;
using ::testing::Contains;
using ::testing::HasSubstr;

/// Pairs of a drive and an estimate of it.
std::vector<FramePair> pairs_of(const Trajectory& truth, const Trajectory& estimate) {
  std::vector<FramePair> pairs;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    FramePair pair;
    pair.frame = static_cast<int>(i);
    pair.stamp_ns = truth.poses[i].stamp_ns;
    pair.T_world_truth = *truth.poses[i].T_world_body;
    pair.T_world_estimate = estimate.poses[i].T_world_body;
    pairs.push_back(pair);
  }
  return pairs;
}

Trajectory moved(Trajectory trajectory, const Eigen::Isometry3d& T, double scale = 1) {
  for (StampedPose& pose : trajectory.poses) {
    pose.T_world_body->translation() *= scale;
    pose.T_world_body = T * *pose.T_world_body;
  }
  return trajectory;
}

Trajectory noisy(Trajectory trajectory, double sigma_m, Random& random) {
  for (StampedPose& pose : trajectory.poses)
    pose.T_world_body->translation() +=
        Eigen::Vector3d(random.normal(0, sigma_m), random.normal(0, sigma_m),
                        random.normal(0, sigma_m));
  return trajectory;
}

TEST(Alignment, ByYawRecoversHeadingAndPositionAndKeepsATilt) {
  const Trajectory truth = test::winding_drive(80);
  for (const Vertical choice : {Vertical::kX, Vertical::kY, Vertical::kZ}) {
    const VerticalResult vertical = vertical_of({}, true, choice);
    const Eigen::Isometry3d T = isometry(2.2 * vertical.axis, {3, -4, 5});
    const AlignmentResult found = align(pairs_of(moved(truth, T), truth), Alignment::kYaw, {},
                                        vertical.axis);
    ASSERT_TRUE(found.outcome) << found.outcome.reason;
    EXPECT_LT((found.R_truth_estimate - T.linear()).norm(), 1e-12);
    EXPECT_LT((found.t_truth_estimate - T.translation()).norm(), 1e-10);
    // A tilt is an error that a known gravity does not forgive.
    const Eigen::Vector3d level = vertical.axis.unitOrthogonal();
    const Trajectory tilted = moved(truth, isometry(0.05 * level, {0, 0, 0}));
    const AlignmentResult kept =
        align(pairs_of(truth, tilted), Alignment::kYaw, {}, vertical.axis);
    EXPECT_NEAR((kept.R_truth_estimate * vertical.axis - vertical.axis).norm(), 0, 1e-12);
    EXPECT_GT(kept.rmse_m, 0.1);
  }
}

TEST(Alignment, IsFittedToTheSpanAlone) {
  Random random(1);
  const Trajectory truth = test::winding_drive(200);
  Trajectory estimate = truth;
  // A jump of 10 m at frame 100.
  for (std::size_t i = 100; i < 200; ++i)
    estimate.poses[i].T_world_body->translation() += Eigen::Vector3d(10, 0, 0);
  using Unit = AlignmentSpan::Unit;
  for (const AlignmentSpan& span : {AlignmentSpan{Unit::kFrames, 0, 100},
                                    AlignmentSpan{Unit::kSeconds, 0, 10},
                                    AlignmentSpan{Unit::kPoses, 0, 100}}) {
    EvaluationOptions options;
    options.align_over = span;
    const EvaluationResult result = evaluate(truth, estimate, options);
    ASSERT_TRUE(result.outcome) << to_string(span);
    EXPECT_EQ(result.alignment.pairs, 100) << to_string(span);
    EXPECT_NEAR(result.ape.error_m.rmse, 10 / std::sqrt(2.0), 1e-9) << to_string(span);
  }
  EvaluationOptions options;
  options.align_over = {Unit::kFrames, 100, 1e12};
  EXPECT_NEAR(evaluate(truth, estimate, options).ape.error_m.min, 0, 1e-9);
  options.align_over = {Unit::kFrames, 300, 400};
  EXPECT_EQ(evaluate(truth, estimate, options).outcome.code, Outcome::Code::kTooFewData);
  options.align_over = {Unit::kSeconds, 0, 10};
  const Trajectory untimed = test::winding_drive(200, 1, false);
  EXPECT_EQ(evaluate(untimed, untimed, options).outcome.code, Outcome::Code::kInconsistent);
}

TEST(Alignment, ByOriginTakesTheFirstPoseOfTheSpan) {
  const Trajectory truth = test::winding_drive(50);
  Trajectory estimate = truth;
  estimate.poses[0].T_world_body->translation() += Eigen::Vector3d(7, 0, 0);
  EvaluationOptions options;
  options.alignment = Alignment::kOrigin;
  options.align_over = {AlignmentSpan::Unit::kFrames, 1, 1e12};
  EXPECT_NEAR(evaluate(truth, estimate, options).ape.error_m.median, 0, 1e-12);
}

TEST(Alignment, NamesTheAxisThatALineLeavesFree) {
  Random random(2);
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 100; ++i) poses.push_back(isometry({0, 0, 0}, {double(i), 0, 0}));
  const Trajectory line = test::trajectory_of(poses);
  for (const double sigma_m : {0.0, 0.05}) {
    const EvaluationResult result = evaluate(line, noisy(line, sigma_m, random));
    ASSERT_EQ(result.alignment.free_axes.size(), 1u) << sigma_m;
    EXPECT_NEAR(std::abs(result.alignment.free_axes[0][0]), 1, 1e-3);
    EXPECT_THAT(result.warnings, Contains(HasSubstr("the rotation about (")));
    EXPECT_FALSE(result.ape.rotation_outcome);
    for (const Metric& metric : metrics(result))
      EXPECT_EQ(metric.value.has_value() && metric.key.starts_with("are_"), false) << metric.key;
  }
  // A drive that bends shows it.
  const Trajectory bent = test::winding_drive(100);
  EXPECT_TRUE(evaluate(bent, noisy(bent, 0.05, random)).alignment.free_axes.empty());
}

TEST(Alignment, RefusesTheScaleOfAnEstimateThatStandsWithinItsNoise) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Random random(seed);
    const int frames = 10 + 20 * int(seed);
    const Trajectory truth = test::winding_drive(frames);
    const Trajectory standing =
        noisy(test::trajectory_of(std::vector<Eigen::Isometry3d>(
                  std::size_t(frames), Eigen::Isometry3d::Identity())),
              std::pow(10, random.uniform(-6, -1)), random);
    for (const Alignment alignment : {Alignment::kSim3, Alignment::kScale}) {
      EvaluationOptions options;
      options.alignment = alignment;
      const EvaluationResult result = evaluate(truth, standing, options);
      EXPECT_EQ(result.outcome.code, Outcome::Code::kDegenerate)
          << seed << " " << to_string(alignment) << " explained " << result.alignment.explained;
    }
    // And of a truth that stands while the estimate drives.
    EvaluationOptions options;
    options.alignment = Alignment::kSim3;
    EXPECT_FALSE(evaluate(standing, truth, options).outcome) << seed;
    const EvaluationResult rigid = evaluate(truth, standing);
    ASSERT_TRUE(rigid.outcome);
    EXPECT_FALSE(rigid.ape.rotation_outcome) << seed;
  }
}

TEST(Alignment, KeepsTheScaleOfADriftingEstimate) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Random random(seed);
    const Trajectory truth = test::winding_drive(10 + 10 * int(seed));
    EvaluationOptions options;
    options.alignment = Alignment::kSim3;
    const Trajectory estimate =
        moved(test::drifting(truth, 0.05, 0.01, random), isometry({1, 2, 3}, {5, 5, 5}), 0.01);
    const EvaluationResult result = evaluate(truth, estimate, options);
    ASSERT_TRUE(result.outcome) << result.outcome.reason;
    EXPECT_NEAR(result.alignment.scale, 100, 15) << seed;
  }
}

TEST(Alignment, NamesAMirrorImage) {
  Random random(6);
  Trajectory truth = test::winding_drive(150);
  for (std::size_t i = 0; i < truth.size(); ++i)  // out of the plane
    truth.poses[i].T_world_body->translation() += Eigen::Vector3d(0, 20 * std::sin(i * 0.05), 0);
  Trajectory mirrored = truth;
  for (StampedPose& pose : mirrored.poses) {
    const Eigen::Matrix3d M = Eigen::Vector3d(-1, 1, 1).asDiagonal();
    pose.T_world_body->translation() = M * pose.T_world_body->translation();
    pose.T_world_body->linear() = M * pose.T_world_body->linear() * M;
  }
  const EvaluationResult result = evaluate(truth, mirrored);
  EXPECT_TRUE(result.alignment.mirrored);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("mirror image")));
  EXPECT_FALSE(evaluate(truth, noisy(truth, 0.1, random)).alignment.mirrored);
  // In a plane it fits turned over; the orientations tell.
  Trajectory flat = truth, flat_mirrored = mirrored;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    flat.poses[i].T_world_body->translation()[1] = 0;
    flat_mirrored.poses[i].T_world_body->translation()[1] = 0;
  }
  EXPECT_THAT(evaluate(flat, flat_mirrored).warnings, Contains(HasSubstr("turned over")));
}

TEST(Alignment, SaysThatFewPosesAreFewerThanTheNumbersOfTheFit) {
  EvaluationOptions options;
  options.alignment = Alignment::kSim3;
  options.align_over = {AlignmentSpan::Unit::kPoses, 0, 5};
  Random random(8);
  const Trajectory truth = test::winding_drive(50);
  EXPECT_THAT(evaluate(truth, noisy(truth, 0.01, random), options).warnings,
              Contains(HasSubstr("fits 7 numbers to 5 poses")));
}

TEST(Vertical, IsTheAxisThatTheBodyTurnsAbout) {
  // The winding drive turns about y, as a camera that looks ahead.
  const Trajectory drive = test::winding_drive(200);
  const VerticalResult camera = vertical_of(pairs_of(drive, drive), true, Vertical::kEstimated);
  ASSERT_TRUE(camera.outcome);
  EXPECT_EQ(camera.text, "y (estimated)");
  // The same drive in a world whose z is up, whatever its heading.
  const Trajectory level = moved(drive, isometry({-std::numbers::pi / 2, 0, 0}, {0, 0, 0}));
  EXPECT_EQ(vertical_of(pairs_of(level, level), true, Vertical::kEstimated).text, "z (estimated)");
  // A world that is tilted by more than ten degrees has no axis that is vertical.
  const Trajectory tilted = moved(drive, isometry({0.4, 0, 0}, {0, 0, 0}));
  const VerticalResult oblique =
      vertical_of(pairs_of(tilted, tilted), true, Vertical::kEstimated);
  const Eigen::Vector3d up = isometry({0.4, 0, 0}, {0, 0, 0}).linear().col(1);
  EXPECT_GT(std::abs(oblique.axis.dot(up)), std::cos(5 * kRadPerDeg));
  // Positions alone show the plane that they lie in.
  EXPECT_EQ(vertical_of(pairs_of(level, level), false, Vertical::kEstimated).axis[2] != 0, true);
}

TEST(Vertical, IsRefusedWhereTheBodyTurnsAboutEveryAxis) {
  Random random(9);
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 200; ++i)
    poses.push_back(isometry({random.normal(), random.normal(), random.normal()},
                             {random.normal(), random.normal(), random.normal()}));
  const Trajectory tumbling = test::trajectory_of(poses);
  const VerticalResult none =
      vertical_of(pairs_of(tumbling, tumbling), true, Vertical::kEstimated);
  EXPECT_EQ(none.outcome.code, Outcome::Code::kDegenerate);
  EXPECT_THAT(none.outcome.reason, HasSubstr("--vertical"));
}

}  // namespace alignment_test
}  // namespace placegraph
