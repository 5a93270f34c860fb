#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/offsets/offset_estimation.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/unit/eval/offsets/offset_worlds.h"

namespace placegraph {
namespace offset_estimation_test {

using test::OffsetWorld;
using test::SmoothMotion;
using testing::HasSubstr;

/// A camera in the hand: decimetres and tens of degrees within seconds.
const Vector6d kHand = (Vector6d() << 0.5, 0.5, 0.3, 0.3, 0.3, 0.5).finished();
/// A vehicle on a plane: it turns about z alone.
const Vector6d kPlane = (Vector6d() << 5, 5, 0, 0, 0, 1).finished();

Eigen::Vector3d random_vector(double most, Random& random) {
  return {random.uniform(-most, most), random.uniform(-most, most), random.uniform(-most, most)};
}

OffsetWorld world_of(const Vector6d& amplitude, Random& random) {
  OffsetWorld world;
  world.T_world_truth = SmoothMotion(amplitude, random);
  world.T_estimate_truth = SE3(SO3::exp(random_vector(1.2, random)), random_vector(0.5, random));
  world.T_world_other = SE3(SO3::exp(random_vector(1.5, random)), random_vector(10, random));
  world.time_s = random.uniform(-0.3, 0.3);
  world.duration_s = 40;
  world.truth_hz = 25;
  world.estimate_hz = 20;
  return world;
}

OffsetOptions both() {
  OffsetOptions options;
  options.body = options.time = true;
  return options;
}

/// Errors of lever arm, rotation and time, and their deviations.
struct OffsetErrors {
  Eigen::Matrix<double, 7, 1> error, deviation;
  OffsetErrors(const OffsetEstimate& found, const OffsetWorld& world) {
    const SO3 R = found.T_estimate_truth.rotation() * world.T_estimate_truth.rotation().inverse();
    error << found.T_estimate_truth.translation() - world.T_estimate_truth.translation(), R.log(),
        found.time_s - world.time_s;
    deviation << found.lever_arm_deviation_m, found.rotation_deviation_rad, found.time_deviation_s;
  }
};

TEST(OffsetEstimation, FindsTheOffsetsOfExactPoses) {
  for (int seed = 0; seed < 8; ++seed) {
    Random random(seed);
    const OffsetWorld world = world_of(kHand, random);
    const OffsetEstimate found =
        estimate_offsets(world.truth(random), world.estimate(random), both());
    ASSERT_TRUE(found.outcome) << "seed " << seed << ": " << found.outcome.reason;
    // The cubic between poses of 25 Hz errs by 1e-5 of a period of 2 s.
    EXPECT_LT(OffsetErrors(found, world).error.cwiseAbs().maxCoeff(), 2e-4) << "seed " << seed;
    EXPECT_TRUE(found.free.empty()) << "seed " << seed << ": " << found.free.front().text;
  }
}

TEST(OffsetEstimation, TheOtherWayRoundIsTheInverse) {
  Random random(11);
  const OffsetWorld world = world_of(kHand, random);
  const Trajectory truth = world.truth(random), estimate = world.estimate(random);
  const OffsetEstimate forth = estimate_offsets(truth, estimate, both());
  const OffsetEstimate back = estimate_offsets(estimate, truth, both());
  ASSERT_TRUE(forth.outcome && back.outcome);
  EXPECT_LT((forth.T_estimate_truth * back.T_estimate_truth).log().norm(), 5e-4);
  EXPECT_NEAR(forth.time_s, -back.time_s, 2e-4);
}

TEST(OffsetEstimation, TheFrameOfTheWorldDoesNotMatter) {
  Random random(12);
  OffsetWorld world = world_of(kHand, random);
  world.estimate_m = world.estimate_rad = 0.005;
  const Trajectory truth = world.truth(random), estimate = world.estimate(random);
  Trajectory moved = estimate;
  const Eigen::Isometry3d T = SE3(SO3::exp({1, 2, -1}), {100, -50, 3}).isometry();
  for (StampedPose& pose : moved.poses) pose.T_world_body = T * *pose.T_world_body;
  const OffsetEstimate one = estimate_offsets(truth, estimate, both());
  const OffsetEstimate other = estimate_offsets(truth, moved, both());
  ASSERT_TRUE(one.outcome && other.outcome);
  EXPECT_LT((one.T_estimate_truth.inverse() * other.T_estimate_truth).log().norm(), 1e-8);
  EXPECT_NEAR(one.time_s, other.time_s, 1e-8);
  EXPECT_LT((one.lever_arm_deviation_m - other.lever_arm_deviation_m).norm(), 1e-8);
}

/// Mean square of error over deviation, and share within 1.96 deviations, over worlds and
/// parameters.
std::pair<double, double> consistency(int worlds, const std::function<void(OffsetWorld&)>& noise) {
  double squares = 0, within = 0, count = 0;
  for (int seed = 0; seed < worlds; ++seed) {
    Random random(seed, "consistency", {});
    OffsetWorld world = world_of(kHand, random);
    noise(world);
    const OffsetEstimate found =
        estimate_offsets(world.truth(random), world.estimate(random), both());
    EXPECT_TRUE(found.outcome) << "seed " << seed << ": " << found.outcome.reason;
    if (!found.outcome) continue;
    const OffsetErrors errors(found, world);
    for (int k = 0; k < 7; ++k) {
      const double ratio = errors.error[k] / errors.deviation[k];
      squares += ratio * ratio;
      within += std::abs(ratio) < 1.96;
      ++count;
    }
  }
  return {squares / count, within / count};
}

// 40 worlds of 7 parameters: the share of 95 % has a standard deviation of 1.3 % to 3.4 % (none to
// all parameters of a world as one), the mean square of 0.08 to 0.22.
TEST(OffsetEstimation, DeviationsHoldForWhiteNoise) {
  const auto [nees, within] = consistency(40, [](OffsetWorld& world) {
    world.truth_m = world.truth_rad = 0.001;
    world.estimate_m = 0.01;
    world.estimate_rad = 0.005;
  });
  EXPECT_GT(nees, 0.5);
  EXPECT_LT(nees, 2);
  EXPECT_GT(within, 0.88);
}

TEST(OffsetEstimation, DeviationsHoldForDrift) {
  const auto [nees, within] = consistency(40, [](OffsetWorld& world) {
    world.walk_m = 0.02;
    world.walk_rad = 0.01;
  });
  EXPECT_GT(nees, 0.4);
  EXPECT_LT(nees, 2);
  EXPECT_GT(within, 0.88);
}

TEST(OffsetEstimation, FindsSecondsOfTimeByTheSpeeds) {
  for (const double time_s : {-4.3, 2.71, 4.9}) {
    Random random(21);
    OffsetWorld world = world_of(kHand, random);
    world.time_s = time_s;
    world.estimate_m = world.estimate_rad = 0.005;
    const OffsetEstimate found =
        estimate_offsets(world.truth(random), world.estimate(random), both());
    ASSERT_TRUE(found.outcome) << found.outcome.reason;
    EXPECT_NEAR(found.time_s, time_s, 5 * found.time_deviation_s);
    EXPECT_LT(found.time_deviation_s, 0.01);
  }
}

TEST(OffsetEstimation, WhatIsKnownBeforehandIsPartOfTheTime) {
  Random random(22);
  OffsetWorld world = world_of(kHand, random);
  world.time_s = 12.2;  // beyond what is sought
  OffsetOptions options = both();
  options.start_s = 12;
  const OffsetEstimate found =
      estimate_offsets(world.truth(random), world.estimate(random), options);
  ASSERT_TRUE(found.outcome) << found.outcome.reason;
  EXPECT_NEAR(found.time_s, 12.2, 1e-3);
}

TEST(OffsetEstimation, FitsAScaleAlong) {
  Random random(23);
  OffsetWorld world = world_of(kHand, random);
  world.scale = 2.5;
  OffsetOptions options = both();
  options.scale = true;
  const Trajectory truth = world.truth(random), estimate = world.estimate(random);
  const OffsetEstimate found = estimate_offsets(truth, estimate, options);
  ASSERT_TRUE(found.outcome) << found.outcome.reason;
  EXPECT_NEAR(found.scale, 2.5, 1e-3);
  EXPECT_LT(OffsetErrors(found, world).error.cwiseAbs().maxCoeff(), 1e-3);
}

TEST(OffsetEstimation, OutliersAndGapsDoNotMoveIt) {
  Random random(24);
  OffsetWorld world = world_of(kHand, random);
  world.estimate_m = world.estimate_rad = 0.005;
  Trajectory truth = world.truth(random), estimate = world.estimate(random);
  for (std::size_t i = 0; i < estimate.size(); i += 25)
    estimate.poses[i].T_world_body->translation() += random_vector(3, random);
  // Ten seconds without truth, two lost frames in ten of the estimate.
  truth.poses.erase(truth.poses.begin() + 300, truth.poses.begin() + 550);
  for (std::size_t i = 0; i < estimate.size(); i += 10)
    estimate.poses[i].T_world_body.reset(), estimate.poses[i + 1].T_world_body.reset();
  const OffsetEstimate found = estimate_offsets(truth, estimate, both());
  ASSERT_TRUE(found.outcome) << found.outcome.reason;
  const OffsetErrors errors(found, world);
  for (int k = 0; k < 7; ++k)
    EXPECT_LT(std::abs(errors.error[k]), 4 * errors.deviation[k]) << "parameter " << k;
  EXPECT_LT(errors.deviation.maxCoeff(), 0.01);
}

TEST(OffsetEstimation, OnAPlaneTheLeverArmAlongTheAxisIsFree) {
  for (int seed = 0; seed < 6; ++seed) {
    Random random(seed);
    OffsetWorld world = world_of(kPlane, random);
    world.T_estimate_truth = SE3(SO3::exp({0, 0, 0.7}), {1.2, -0.4, 0.9});
    world.estimate_m = world.truth_m = 0.01;
    world.estimate_rad = world.truth_rad = 0.003;
    const OffsetEstimate found =
        estimate_offsets(world.truth(random), world.estimate(random), both());
    ASSERT_TRUE(found.outcome) << "seed " << seed << ": " << found.outcome.reason;
    ASSERT_EQ(found.free.size(), 1u) << "seed " << seed;
    EXPECT_GT(found.free[0].lever_arm.z(), 0.99) << "seed " << seed;
    EXPECT_THAT(found.free[0].text, HasSubstr("lever arm along (0.00 0.00 1.00) is free"));
    EXPECT_TRUE(std::isinf(found.lever_arm_deviation_m.z()));
    EXPECT_NEAR(found.free[0].lever_arm.dot(found.T_estimate_truth.translation()), 0, 1e-9);
    EXPECT_NEAR(found.T_estimate_truth.translation().z(), 0, 0.02) << "seed " << seed;
    const OffsetErrors errors(found, world);
    for (const int k : {0, 1, 3, 4, 5, 6})
      EXPECT_LT(std::abs(errors.error[k]), 4.5 * errors.deviation[k]) << seed << " of " << k;
  }
}

TEST(OffsetEstimation, WithoutRotationTheLeverArmIsFreeAndTheRotationIsNot) {
  Random random(31);
  OffsetWorld world = world_of((Vector6d() << 1, 1, 1, 0, 0, 0).finished(), random);
  world.estimate_m = world.estimate_rad = 0.002;
  OffsetOptions options;
  options.body = true;
  world.time_s = 0;
  const OffsetEstimate found =
      estimate_offsets(world.truth(random), world.estimate(random), options);
  ASSERT_TRUE(found.outcome) << found.outcome.reason;
  ASSERT_EQ(found.free.size(), 1u);
  EXPECT_EQ(found.free[0].text, "the lever arm is free: the body does not turn");
  EXPECT_TRUE(found.lever_arm_deviation_m.array().isInf().all());
  EXPECT_LT(found.T_estimate_truth.translation().norm(), 0.02);
  const OffsetErrors errors(found, world);
  for (int k = 3; k < 6; ++k) EXPECT_LT(std::abs(errors.error[k]), 4.5 * errors.deviation[k]);
}

/// A body that moves and turns at a constant rate.
OffsetWorld steady(const Vector6d& twist) {
  OffsetWorld world;
  world.T_world_truth = [twist](double t) { return SE3::exp(Vector6d(t * twist)); };
  world.T_estimate_truth = SE3(SO3(), {0.3, 0.2, 0.1});
  world.truth_m = world.estimate_m = 0.01;
  world.truth_rad = world.estimate_rad = 0.002;
  return world;
}

TEST(OffsetEstimation, AtConstantVelocityATimeIsRefused) {
  OffsetOptions options;
  options.time = true;
  for (const Vector6d& twist : {(Vector6d() << 5, 0, 0, 0, 0, 0).finished(),
                                (Vector6d() << 5, 0, 0, 0, 0, 0.3).finished(),
                                Vector6d(Vector6d::Zero())}) {
    Random random(41);
    const OffsetWorld world = steady(twist);
    const OffsetEstimate found =
        estimate_offsets(world.truth(random), world.estimate(random), options);
    EXPECT_EQ(found.outcome.code, Outcome::Code::kDegenerate) << twist.transpose();
    EXPECT_THAT(found.outcome.reason, HasSubstr("the time offset is free"));
    EXPECT_EQ(found.time_s, 0);
    EXPECT_TRUE(std::isinf(found.time_deviation_s));
  }
}

TEST(OffsetEstimation, ABodyThatStandsStillShowsNothing) {
  Random random(42);
  const OffsetWorld world = steady(Vector6d::Zero());
  OffsetOptions options;
  options.body = true;
  const OffsetEstimate found =
      estimate_offsets(world.truth(random), world.estimate(random), options);
  EXPECT_EQ(found.outcome.code, Outcome::Code::kDegenerate);
  EXPECT_THAT(found.outcome.reason, HasSubstr("it stands still"));
  EXPECT_THAT(to_text(found), HasSubstr("no offsets: the lever arm is free"));
}

TEST(OffsetEstimation, InACircleALeverArmIsFreeTogetherWithTheScaleAndFitsWithIt) {
  const Vector6d twist = (Vector6d() << 5, 0, 0, 0, 0, 0.3).finished();
  for (int seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    OffsetWorld world = steady(twist);
    world.T_estimate_truth =
        SE3(SO3::exp({0, 0, random.uniform(-0.5, 0.5)}), random_vector(0.5, random));
    world.scale = random.uniform(0.4, 2.5);
    world.truth_m = world.estimate_m = world.truth_rad = world.estimate_rad = 0;
    OffsetOptions options;
    options.body = options.scale = true;
    const OffsetEstimate found =
        estimate_offsets(world.truth(random), world.estimate(random), options);
    ASSERT_TRUE(found.outcome) << found.outcome.reason;
    const auto with_scale = std::ranges::find(found.free, true, &FreeOffset::scale);
    ASSERT_NE(with_scale, found.free.end());
    EXPECT_GT(with_scale->lever_arm.norm(), 0.99);
    EXPECT_THAT(with_scale->text, HasSubstr("together with the scale is free"));
    // Velocity of the truth's body in its own frame, by what was found: the parts fit each other.
    const Vector6d of_estimate = world.T_estimate_truth.adjoint() * twist;
    Vector6d scaled = of_estimate;
    scaled.head<3>() *= found.scale / world.scale;
    const Vector6d predicted = found.T_estimate_truth.inverse().adjoint() * scaled;
    EXPECT_LT((predicted - twist).norm(), 1e-4);
  }
}

TEST(OffsetEstimation, WithoutRotationTheScaleIsShownAndTheLeverArmAloneFree) {
  Random random(48);
  OffsetWorld world = steady((Vector6d() << 5, 0, 0, 0, 0, 0).finished());
  world.scale = 0.4;
  OffsetOptions options;
  options.body = options.scale = true;
  const OffsetEstimate found =
      estimate_offsets(world.truth(random), world.estimate(random), options);
  ASSERT_TRUE(found.outcome) << found.outcome.reason;
  EXPECT_NEAR(found.scale, 0.4, 1e-3);
  EXPECT_EQ(found.T_estimate_truth.translation().norm(), 0);
  for (const FreeOffset& free : found.free) EXPECT_FALSE(free.scale) << free.text;
}

TEST(OffsetEstimation, OnALineTheRotationAboutItIsFree) {
  Random random(43);
  OffsetWorld world = steady(Vector6d::Zero());
  const SmoothMotion along((Vector6d() << 4, 0, 0, 0, 0, 0).finished(), random);
  world.T_world_truth = along;
  const OffsetEstimate found =
      estimate_offsets(world.truth(random), world.estimate(random), both());
  ASSERT_TRUE(found.outcome) << found.outcome.reason;
  ASSERT_EQ(found.free.size(), 2u);
  EXPECT_THAT(found.free[1].text, HasSubstr("the rotation about (1.00 0.00 0.00) is free"));
  EXPECT_NEAR(found.time_s, 0, 5 * found.time_deviation_s);
  const Eigen::Vector3d rotation = found.T_estimate_truth.rotation().log();
  for (int axis = 1; axis < 3; ++axis) {
    EXPECT_LT(found.rotation_deviation_rad[axis], 0.01);
    EXPECT_LT(std::abs(rotation[axis]), 5 * found.rotation_deviation_rad[axis]);
  }
  // Of the free axis 0.01 rad of the first guess remain, where none would be right.
  EXPECT_LT(std::abs(rotation[0]), 0.02);
}

TEST(OffsetEstimation, PositionsAloneShowTheTimeAndALeverArm) {
  for (int seed = 0; seed < 4; ++seed) {
    Random random(seed);
    OffsetWorld world = world_of(kHand, random);
    world.T_estimate_truth = SE3(SO3(), world.T_estimate_truth.translation());
    world.truth_m = world.estimate_m = 0.002;
    world.estimate_rad = 0.001;
    Trajectory truth = world.truth(random);
    truth.has_orientation = false;
    for (StampedPose& pose : truth.poses) pose.T_world_body->linear().setIdentity();
    const OffsetEstimate found = estimate_offsets(truth, world.estimate(random), both());
    ASSERT_TRUE(found.outcome) << found.outcome.reason;
    EXPECT_FALSE(found.has_rotation);
    const OffsetErrors errors(found, world);
    for (const int k : {0, 1, 2, 6})
      EXPECT_LT(std::abs(errors.error[k]), 4.5 * errors.deviation[k]) << seed << " of " << k;
    EXPECT_LT(found.lever_arm_deviation_m.maxCoeff(), 0.01);
    EXPECT_LT(found.T_estimate_truth.rotation().log().norm(), 1e-12);
  }
}

TEST(OffsetEstimation, TheCorrectedEstimateAgreesWithTheTruth) {
  for (const double scale : {1.0, 0.4}) {
    Random random(51);
    OffsetWorld world = world_of(kHand, random);
    world.scale = scale;
    world.truth_hz = world.estimate_hz = 50;
    OffsetOptions options = both();
    options.scale = scale != 1;
    const Trajectory truth = world.truth(random), estimate = world.estimate(random);
    const OffsetEstimate found = estimate_offsets(truth, estimate, options);
    ASSERT_TRUE(found.outcome) << found.outcome.reason;
    EvaluationOptions protocol;
    protocol.alignment = scale == 1 ? Alignment::kSe3 : Alignment::kSim3;
    const EvaluationResult before = evaluate(truth, estimate, protocol);
    const EvaluationResult after = evaluate(truth, with_offsets(estimate, found), protocol);
    ASSERT_TRUE(before.outcome && after.outcome);
    EXPECT_GT(before.ape.error_m.rmse, 0.1);
    // Poses of 50 Hz are 10 ms from their partners at most; speeds are about 1 m/s.
    EXPECT_LT(after.ape.error_m.rmse, 0.03);
  }
}

TEST(OffsetEstimation, FramesWithoutTimesShowTheBody) {
  Random random(52);
  OffsetWorld world = world_of(kHand, random);
  world.time_s = 0;
  world.truth_hz = world.estimate_hz = 10;
  Trajectory truth = world.truth(random), estimate = truth;
  for (StampedPose& pose : estimate.poses)
    pose.T_world_body = *pose.T_world_body * world.T_estimate_truth.inverse().isometry();
  for (Trajectory* trajectory : {&truth, &estimate}) {
    trajectory->has_times = false;
    std::int64_t frame = 0;
    for (StampedPose& pose : trajectory->poses) pose.stamp_ns = frame++;
  }
  OffsetOptions options;
  options.body = true;
  const OffsetEstimate found = estimate_offsets(truth, estimate, options);
  ASSERT_TRUE(found.outcome) << found.outcome.reason;
  EXPECT_LT((found.T_estimate_truth.inverse() * world.T_estimate_truth).log().norm(), 1e-6);
  options.time = true;
  EXPECT_EQ(estimate_offsets(truth, estimate, options).outcome.code,
            Outcome::Code::kInconsistent);
}

TEST(OffsetEstimation, SaysWhatIsMissing) {
  Random random(53);
  const OffsetWorld world = world_of(kHand, random);
  Trajectory truth = world.truth(random), estimate = world.estimate(random);
  EXPECT_THROW((void)estimate_offsets(truth, estimate, {}), ArgumentError);
  OffsetOptions wrong = both();
  wrong.max_time_s = -1;
  EXPECT_THROW((void)estimate_offsets(truth, estimate, wrong), ArgumentError);
  Trajectory backward = estimate;
  std::swap(backward.poses[3], backward.poses[4]);
  EXPECT_THROW((void)estimate_offsets(truth, backward, both()), ArgumentError);

  Trajectory short_one = estimate;
  short_one.poses.resize(20);
  const OffsetEstimate few = estimate_offsets(truth, short_one, both());
  EXPECT_EQ(few.outcome.code, Outcome::Code::kTooFewData);
  EXPECT_THAT(few.outcome.reason, HasSubstr("the offsets need 48 poses"));
  Trajectory positions = estimate;
  positions.has_orientation = false;
  EXPECT_EQ(estimate_offsets(truth, positions, both()).outcome.code, Outcome::Code::kTooFewData);
  Trajectory frames = estimate;
  frames.has_times = false;
  EXPECT_EQ(estimate_offsets(truth, frames, both()).outcome.code, Outcome::Code::kInconsistent);
}

TEST(OffsetReport, HasValuesDeviationsAndWhatIsFree) {
  OffsetEstimate offsets;
  offsets.outcome = Outcome::ok();
  offsets.with_body = offsets.with_time = true;
  offsets.T_estimate_truth = SE3(SO3::exp({0, 0, 0.5}), {0.25, -0.5, 0});
  offsets.time_s = 0.03;
  offsets.time_deviation_s = 0.001;
  offsets.lever_arm_deviation_m = {0.01, 0.02, std::numeric_limits<double>::infinity()};
  offsets.rotation_deviation_rad = {0.01, 0.01, 0.01};
  offsets.free = {{{0, 0, 1}, {0, 0, 0}, false, false, "the lever arm along z is free: so it is"}};
  const std::string text = to_text(offsets);
  EXPECT_THAT(text, HasSubstr("(0.2500 -0.5000 0.0000) +- (0.0100 0.0200 free) m"));
  EXPECT_THAT(text, HasSubstr("(0.000 0.000 28.648) +- (0.573 0.573 0.573) deg"));
  EXPECT_THAT(text, HasSubstr("0.03000 +- 0.00100 s"));
  EXPECT_THAT(text, HasSubstr("the lever arm along z is free"));
  const nlohmann::json json = nlohmann::json::parse(to_json(offsets));
  EXPECT_EQ(json["outcome"], "ok");
  EXPECT_EQ(json["lever_arm_m"], nlohmann::json({0.25, -0.5, 0.0}));
  EXPECT_EQ(json["lever_arm_deviation_m"], nlohmann::json({0.01, 0.02, nullptr}));
  EXPECT_EQ(json["time_s"], 0.03);
  EXPECT_EQ(json["free"].size(), 1u);
  offsets.outcome = Outcome::failure(Outcome::Code::kDegenerate, "it stands");
  EXPECT_TRUE(nlohmann::json::parse(to_json(offsets))["time_s"].is_null());
  EXPECT_THAT(to_text(offsets), HasSubstr("no offsets: it stands"));
}

}  // namespace offset_estimation_test
}  // namespace placegraph
