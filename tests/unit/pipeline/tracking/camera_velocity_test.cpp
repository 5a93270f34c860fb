#include <gtest/gtest.h>
#include <placegraph/pipeline/tracking/camera_velocity.h>

namespace placegraph {
namespace camera_velocity_test {

SE3 rotated(double angle) { return SE3(SO3::exp({0, angle, 0}), Eigen::Vector3d::Zero()); }

TEST(CameraVelocity, IsZeroUntilAMotionIsKnown) { EXPECT_TRUE(CameraVelocity().at().isZero(0)); }

TEST(CameraVelocity, IsThatOfASteadyMotion) {
  CameraVelocity velocity;
  velocity.update(rotated(0.03), 0.1);
  velocity.update(rotated(0.015), 0.05);
  EXPECT_NEAR(velocity.at()[4], 0.3, 1e-9);
  EXPECT_NEAR(velocity.at(0.2)[4], 0.3, 1e-9);
}

TEST(CameraVelocity, FollowsASlowChangeAndDoubtsAFastOne) {
  CameraVelocity slow, fast;
  slow.update(rotated(0.100), 0.1);
  slow.update(rotated(0.110), 0.1);
  EXPECT_NEAR(slow.at()[4], 1.15, 0.01);  // 1.1 in the middle of the last interval
  fast.update(rotated(-0.1), 0.1);
  fast.update(rotated(0.1), 0.1);
  EXPECT_LT(fast.at()[4], 1);  // a line would end at 2
}

TEST(CameraVelocity, IsKnownFromDenseFramesOnly) {
  CameraVelocity velocity;
  EXPECT_FALSE(velocity.known());
  velocity.update(rotated(0.01), 1.0 / 30);
  EXPECT_TRUE(velocity.known());
  velocity.update(rotated(0.03), 0.1);
  EXPECT_FALSE(velocity.known());
}

}  // namespace camera_velocity_test
}  // namespace placegraph
