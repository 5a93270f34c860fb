#include <gtest/gtest.h>
#include <placegraph/frontend/relative_pose/relative_pose.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace circular_motion_test {

using namespace test;
using Code = Outcome::Code;
const Camera kCamera = pinhole(640, 480, 500);

/// A level car that turns to the right by `yaw_rad` over `length_m`.
SE3 drive(double yaw_rad, double length_m) {
  return pose({0, yaw_rad, 0},
              {length_m * std::sin(yaw_rad / 2), 0, length_m * std::cos(yaw_rad / 2)});
}

TEST(CircularMotion, IsExactWithoutNoise) {
  Random random = seeded_random(41);
  for (const double yaw_rad : {-0.2, -0.01, 0.0, 0.003, 0.15}) {
    const SE3 truth = drive(yaw_rad, 1);
    const PointScene scene = make_scene(kCamera, {SE3(), truth}, 60, random);
    const auto result = estimate_circular_motion(kCamera, scene.px[0], scene.px[1], SO3(), {});
    ASSERT_TRUE(result.outcome) << result.outcome.reason;
    EXPECT_NEAR(result.yaw_rad, yaw_rad, 1e-7);
    EXPECT_LT(angle_rad(result.T_ref_cur, truth), 1e-7);
    EXPECT_LT(angle_between(result.T_ref_cur.translation(), truth.translation()), 1e-7);
    EXPECT_EQ(result.inliers.size(), 60u);
  }
}

TEST(CircularMotion, IsFoundAmongSixtyPercentOutliersByACameraThatIsNotLevel) {
  Random random = seeded_random(42);
  const SO3 R_level_cam = SO3::exp({0.1, 0.05, -0.08});
  const SE3 T_level_cam(R_level_cam, Eigen::Vector3d::Zero());
  const SE3 truth = T_level_cam.inverse() * drive(0.06, 1) * T_level_cam;
  PointScene scene = make_scene(kCamera, {SE3(), truth}, 200, random);
  add_noise(scene.px[1], 0.3, random);
  for (const int first : {0, 1, 2}) spoil(kCamera, scene.px[1], first, 5, random);
  const auto result = estimate_circular_motion(kCamera, scene.px[0], scene.px[1], R_level_cam, {});
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_NEAR(result.yaw_rad, 0.06, 4 * result.sigma_yaw_rad);
  EXPECT_LT(result.sigma_yaw_rad, 1e-3);
  EXPECT_LT(angle_between(result.T_ref_cur.translation(), truth.translation()), 2e-3);
}

TEST(CircularMotion, KnowsBackwardsFromForwards) {
  Random random = seeded_random(43);
  const SE3 truth = drive(0.05, -1);
  const PointScene scene = make_scene(kCamera, {SE3(), truth}, 60, random);
  const auto result = estimate_circular_motion(kCamera, scene.px[0], scene.px[1], SO3(), {});
  ASSERT_TRUE(result.outcome);
  EXPECT_NEAR(result.yaw_rad, 0.05, 1e-7);
  EXPECT_LT(angle_between(result.T_ref_cur.translation(), truth.translation()), 1e-6);
}

TEST(CircularMotion, SaysThatACarThatStandsHasNoMotion) {
  Random random = seeded_random(44);
  PointScene scene = make_scene(kCamera, {SE3(), SE3()}, 60, random);
  add_noise(scene.px[1], 0.1, random);
  const auto result = estimate_circular_motion(kCamera, scene.px[0], scene.px[1], SO3(), {});
  EXPECT_EQ(result.outcome.code, Code::kDegenerate);
}

TEST(CircularMotion, SeesThatASidewaysMotionIsNoCars) {
  Random random = seeded_random(45);
  const PointScene scene =
      make_scene(kCamera, {SE3(), pose({0.1, 0, 0.1}, {0.5, 1.5, 0})}, 100, random);
  const auto result = estimate_circular_motion(kCamera, scene.px[0], scene.px[1], SO3(), {});
  EXPECT_EQ(result.outcome.code, Code::kNoConsensus);
  EXPECT_LT(result.inliers.size(), 30u);
}

TEST(CircularMotion, RefusesTooFewPointsAndUnequalViews) {
  Random random = seeded_random(46);
  const PointScene scene = make_scene(kCamera, {SE3(), drive(0.1, 1)}, 10, random);
  EXPECT_EQ(estimate_circular_motion(kCamera, scene.px[0], scene.px[1], SO3(), {}).outcome.code,
            Code::kTooFewData);
  EXPECT_THROW((void)estimate_circular_motion(kCamera, scene.px[0], {}, SO3(), {}), ArgumentError);
}

}  // namespace circular_motion_test
}  // namespace placegraph
