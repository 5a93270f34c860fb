#include <gtest/gtest.h>
#include <placegraph/pipeline/flight/start_state.h>

#include <numbers>

namespace placegraph {
namespace start_state_test {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kRounding = 1e-12;

PoseMeasurement pose_by_markers() {
  PoseMeasurement pose;
  pose.stamp_ns = 42;
  // Faces along the world's y.
  pose.T_world_body = SE3(SO3::exp({0, 0, std::numbers::pi / 2}), Vector3d(1, 2, 3));
  Vector6d sigma;
  sigma << 0.1, 0.2, 0.3, 0.04, 0.05, 0.06;
  pose.covariance = sigma.cwiseAbs2().asDiagonal();
  pose.covariance(0, 4) = pose.covariance(4, 0) = 0.002;
  return pose;
}

TEST(StartState, RotatesThePositionsCovarianceIntoTheAxesOfTheWorld) {
  const PoseMeasurement pose = pose_by_markers();
  const BodyState state = start_state(pose, {});
  EXPECT_EQ(state.stamp_ns, 42);
  EXPECT_EQ(state.T_world_body.translation(), pose.T_world_body.translation());
  const Vector3d position = state.covariance.diagonal().head<3>();
  EXPECT_LT((position - Vector3d(0.04, 0.01, 0.09)).norm(), kRounding);
  const Vector3d attitude = state.covariance.diagonal().segment<3>(6);
  EXPECT_LT((attitude - Vector3d(0.0016, 0.0025, 0.0036)).norm(), kRounding);
  // The body's x is the world's y; the attitude stays in the axes of the body.
  EXPECT_NEAR(state.covariance(1, 7), 0.002, kRounding);
  EXPECT_NEAR(state.covariance(7, 1), 0.002, kRounding);
}

TEST(StartState, KnowsOfVelocityAndBiasesWhatTheOptionsSay) {
  const FlightInitializationOptions options{
      .velocity_sigma_mps = 2, .gyro_bias_sigma = 0.03, .accel_bias_sigma = 0.4};
  const BodyState state = start_state(pose_by_markers(), options);
  EXPECT_EQ(state.velocity_world.norm() + state.gyro_bias.norm() + state.accel_bias.norm(), 0);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(state.covariance(3 + axis, 3 + axis), 4, kRounding);
    EXPECT_NEAR(state.covariance(9 + axis, 9 + axis), 0.0009, kRounding);
    EXPECT_NEAR(state.covariance(12 + axis, 12 + axis), 0.16, kRounding);
  }
}

TEST(StartState, KeepsTheBiasesThatWereKnownBeforeAndNothingElse) {
  BodyState before;
  before.T_world_body = SE3(SO3(), Vector3d(9, 9, 9));
  before.velocity_world = {7, 7, 7};
  before.gyro_bias = {0.1, 0.2, 0.3};
  before.accel_bias = {0.4, 0.5, 0.6};
  before.covariance.setConstant(0.01);
  before.covariance.diagonal().setConstant(0.5);
  const BodyState state = start_state(pose_by_markers(), {}, before);
  EXPECT_EQ(state.gyro_bias, before.gyro_bias);
  EXPECT_EQ(state.accel_bias, before.accel_bias);
  EXPECT_EQ(state.velocity_world.norm(), 0);
  EXPECT_EQ(state.T_world_body.translation(), Vector3d(1, 2, 3));
  for (int i = 0; i < 15; ++i)
    for (int j = 0; j < 15; ++j) {
      const bool biases = i >= 9 && j >= 9, both_poses = i % 6 < 3 && j % 6 < 3 && i < 9 && j < 9;
      if (biases) {
        EXPECT_EQ(state.covariance(i, j), before.covariance(i, j)) << i << " " << j;
      } else if (i != j && !both_poses) {
        EXPECT_EQ(state.covariance(i, j), 0) << i << " " << j;
      }
    }
}

}  // namespace start_state_test
}  // namespace placegraph
