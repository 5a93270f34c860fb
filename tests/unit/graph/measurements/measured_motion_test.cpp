#include <numbers>

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/measurements/measured_motion.h>

#include "tests/support/scenes/scene.h"

namespace placegraph {
namespace measured_motion_test {

using namespace test;

const SE3 kStep = pose({0, 0, 0.2}, {1, 0, 0});

/// Steps of a second each, without a pause but after the second one.
MeasuredMotion recording() {
  return MeasuredMotion({{0, 1000, kStep, Matrix6d::Identity()},
                         {1000, 2000, kStep, 2 * Matrix6d::Identity()},
                         {2500, 3000, kStep, Matrix6d::Identity()}});
}

TEST(MeasuredMotion, ChainsStepsAndAddsUpTheirCovariances) {
  const auto motion = recording().between(0, 2000);
  ASSERT_TRUE(motion);
  EXPECT_LT(distance_m(motion->T_a_b, kStep * kStep), 1e-12);
  const Matrix6d adjoint = kStep.inverse().adjoint();
  const Matrix6d expected = adjoint * adjoint.transpose() + 2 * Matrix6d::Identity();
  EXPECT_LT((motion->covariance - expected).norm(), 1e-12);
}

TEST(MeasuredMotion, TakesItsShareOfAStep) {
  const auto motion = recording().between(250, 500);
  ASSERT_TRUE(motion);
  EXPECT_LT(distance_m(motion->T_a_b, SE3::exp(0.25 * kStep.log())), 1e-12);
  EXPECT_LT((motion->covariance - 0.25 * Matrix6d::Identity()).norm(), 1e-12);
  const auto across = recording().between(500, 1500), rest = recording().between(1500, 2000);
  ASSERT_TRUE(across && rest);
  EXPECT_LT(distance_m(across->T_a_b * rest->T_a_b, SE3::exp(0.5 * kStep.log()) * kStep), 1e-12);
  EXPECT_LT(distance_m(recording().between(700, 700)->T_a_b, SE3()), 1e-15);
}

TEST(MeasuredMotion, KnowsNothingOutsideTheRecordingAndAcrossGaps) {
  EXPECT_FALSE(recording().between(-1, 500));
  EXPECT_FALSE(recording().between(2600, 3001));
  EXPECT_FALSE(recording().between(1500, 2600));
  EXPECT_FALSE(recording().between(500, 400));
  EXPECT_TRUE(recording().between(2500, 3000));
}

TEST(MeasuredMotion, IsSeenFromAnotherFrameOfTheBody) {
  // A camera 2 m beside the axis: a turn of the body moves it.
  const SE3 T_cam_body = pose({0, 0, 0}, {0, 2, 0});
  const SE3 rotation = pose({0, 0, std::numbers::pi / 2}, {0, 0, 0});
  Matrix6d covariance = Matrix6d::Zero();
  covariance(5, 5) = 0.01;
  const MeasuredMotion motion =
      MeasuredMotion({{0, 10, rotation, covariance}}).seen_from(T_cam_body);
  const auto seen = motion.between(0, 10);
  ASSERT_TRUE(seen);
  // The body is at (0, 2) in the camera, so the camera swings from (0, -2) to (2, 0) about it.
  EXPECT_LT((seen->T_a_b.translation() - Eigen::Vector3d(2, 2, 0)).norm(), 1e-12);
  EXPECT_NEAR(seen->covariance(5, 5), 0.01, 1e-12);
  const double swing = seen->covariance.diagonal().head<3>().sum();
  EXPECT_NEAR(swing, 0.04, 1e-12);
}

TEST(MeasuredMotion, TakesTheStepsOfATrajectoryBetweenPosedNeighbours) {
  Trajectory trajectory;
  for (int i = 0; i < 5; ++i)
    trajectory.poses.push_back({100 * i, pose({0, 0, 0}, {4.0 * i, 0, 0}).isometry()});
  trajectory.poses[3].T_world_body.reset();
  MotionNoise noise;
  noise.translation = 0.1;
  noise.translation_m = 1e-9;
  const MeasuredMotion motion(trajectory, noise);
  EXPECT_EQ(motion.steps().size(), 2u);
  const auto seen = motion.between(0, 100);
  ASSERT_TRUE(seen);
  EXPECT_NEAR(std::sqrt(seen->covariance(0, 0)), 0.2, 1e-9);  // 0.1 times the root of 4 m
  EXPECT_FALSE(motion.between(200, 400));
}

TEST(MeasuredMotion, RefusesStepsThatAreNone) {
  EXPECT_THROW(MeasuredMotion(std::vector<MotionStep>{}), ArgumentError);
  EXPECT_THROW(MeasuredMotion({{5, 5, kStep, {}}}), ArgumentError);
  EXPECT_THROW(MeasuredMotion({{0, 5, kStep, {}}, {4, 9, kStep, {}}}), ArgumentError);
  EXPECT_THROW(MeasuredMotion({{0, 5, pose({0, 0, 0}, {NAN, 0, 0}), {}}}), ArgumentError);
}

}  // namespace measured_motion_test
}  // namespace placegraph
