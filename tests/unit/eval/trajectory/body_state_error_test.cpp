#include <gtest/gtest.h>
#include <placegraph/eval/trajectory/body_state_error.h>

#include <cmath>

namespace placegraph {
namespace body_state_error_test {

using Eigen::Vector3d;

constexpr std::int64_t kStep_ns = 100'000'000;

BodyState state_at(int k) {
  BodyState state;
  state.stamp_ns = 1'000 + k * kStep_ns;
  state.T_world_body = SE3(SO3::exp({0, 0, 0.1 * k}), Vector3d(k, 0, 0));
  state.velocity_world = {10, 0, 0};
  state.covariance.setIdentity();
  return state;
}

std::vector<BodyState> states(int count) {
  std::vector<BodyState> list;
  for (int k = 0; k < count; ++k) list.push_back(state_at(k));
  return list;
}

TEST(BodyStateError, InterpolatesBetweenStates) {
  const auto recording = states(3);
  const auto middle = interpolate(recording, 1'000 + kStep_ns / 2, 0.2);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->T_world_body.translation().x(), 0.5, 1e-12);
  EXPECT_NEAR(middle->T_world_body.rotation().log().z(), 0.05, 1e-12);
  EXPECT_EQ(interpolate(recording, 1'000)->stamp_ns, 1'000);
  EXPECT_FALSE(interpolate(recording, 999));
  EXPECT_FALSE(interpolate(recording, 1'001 + 2 * kStep_ns));
  EXPECT_FALSE(interpolate(recording, 1'500, 0.05));
}

TEST(BodyStateError, IsRootMeanSquareWithoutAlignment) {
  const auto truth = states(4);
  auto estimated = truth;
  estimated[1].T_world_body =
      SE3(estimated[1].T_world_body.rotation(), Vector3d(1, 0.6, 0.8));  // a metre off
  estimated[3].velocity_world.z() += 2;
  estimated[2].T_world_body =
      SE3(SO3::exp({0, 0, 0.2 + 0.5}), estimated[2].T_world_body.translation());
  const BodyStateError error = body_state_error(truth, estimated);
  ASSERT_TRUE(error.outcome);
  EXPECT_EQ(error.compared, 4);
  EXPECT_NEAR(error.position_rmse_m, 0.5, 1e-9);
  EXPECT_NEAR(error.position_max_m, 1, 1e-9);
  EXPECT_NEAR(error.velocity_rmse_mps, 1, 1e-9);
  EXPECT_NEAR(error.attitude_rmse_rad, 0.25, 1e-9);
  EXPECT_NEAR(error.end_error_m, 0, 1e-12);
  EXPECT_NEAR(error.path_length_m, 3, 1e-12);
  // Squares 1, 0.25 and 4 of 15 coordinates, and of three, over four states.
  EXPECT_NEAR(error.anees, 5.25 / 15 / 4, 1e-9);
  EXPECT_NEAR(error.anees_position, 1.0 / 3 / 4, 1e-9);
  EXPECT_NEAR(error.anees_velocity, 4.0 / 3 / 4, 1e-9);
  EXPECT_NEAR(error.anees_attitude, 0.25 / 3 / 4, 1e-9);
}

TEST(BodyStateError, RefusesWhatCannotBeCompared) {
  auto estimated = states(1);
  EXPECT_EQ(body_state_error({}, estimated).outcome.code, Outcome::Code::kTooFewData);
  estimated[0].covariance.setZero();
  const BodyStateError error = body_state_error(states(2), estimated);
  EXPECT_EQ(error.outcome.code, Outcome::Code::kDegenerate);
  EXPECT_EQ(error.compared, 1);
  EXPECT_TRUE(std::isnan(error.anees));
}

}  // namespace body_state_error_test
}  // namespace placegraph
