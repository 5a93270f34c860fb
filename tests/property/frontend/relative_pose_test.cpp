#include <gtest/gtest.h>
#include <placegraph/frontend/relative_pose/epipolar_error.h>
#include <placegraph/frontend/relative_pose/relative_pose.h>
#include <placegraph/graph/core/angle.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace relative_pose_test {

using namespace test;

const Camera kCamera = pinhole(640, 480, 500);

Eigen::Vector3d random_vector(double size, Random& random) {
  return size *
         Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
}

TEST(RelativePose, OfAnyMotionIsRecoveredByThreePointsAndTheVerticals) {
  Random random = seeded_random(71);
  for (int run = 0; run < 60; ++run) {
    const SE3 truth = pose(random_vector(0.3, random), random_vector(1, random));
    const PointScene scene = make_scene(kCamera, {SE3(), truth}, 50, random);
    ASSERT_EQ(scene.points_ref.size(), 50u);
    const Eigen::Vector3d down = random_vector(1, random).normalized();
    const auto result = estimate_pose_with_gravity(kCamera, scene.px[0], scene.px[1], down,
                                                   truth.rotation().inverse() * down, {}, random);
    ASSERT_TRUE(result.outcome) << run << ": " << result.outcome.reason;
    EXPECT_LT(angle_rad(result.T_ref_cur, truth), 1e-6) << run;
    EXPECT_LT(angle_between(result.T_ref_cur.translation(), truth.translation()), 1e-5) << run;
  }
}

TEST(RelativePose, FromVerticalsLiesWithinItsCovariance) {
  Random random = seeded_random(72);
  constexpr int kRuns = 100;
  double nees = 0;
  for (int run = 0; run < kRuns; ++run) {
    const SE3 truth = pose(random_vector(0.2, random), random_vector(1, random).normalized());
    PointScene scene = make_scene(kCamera, {SE3(), truth}, 80, random);
    ASSERT_EQ(scene.points_ref.size(), 80u);
    for (auto& px : scene.px) add_noise(px, 0.4, random);
    GravityPoseOptions options;
    options.threshold_px = 2;
    const double sigma = deg_to_rad(options.sigma_gravity_deg);
    const auto measured = [&](const Eigen::Vector3d& down) {
      const Eigen::Vector3d e = down.unitOrthogonal();
      return Eigen::Vector3d(
          SO3::exp(random.normal(0, sigma) * e + random.normal(0, sigma) * down.cross(e)) * down);
    };
    const Eigen::Vector3d down = random_vector(1, random).normalized();
    const auto result =
        estimate_pose_with_gravity(kCamera, scene.px[0], scene.px[1], measured(down),
                                   measured(truth.rotation().inverse() * down), options, random);
    ASSERT_TRUE(result.outcome) << run << ": " << result.outcome.reason;
    const SE3 unit(truth.rotation(), truth.translation().normalized());
    const Vector6d error = (unit.inverse() * result.T_ref_cur).log();
    nees += error.dot(result.information * error) / kRuns;
  }
  // Five degrees of freedom; motions close to the depths' size make single runs heavy-tailed, and
  // Huber's weights claim less than there is.
  EXPECT_GT(nees, 5 * 0.6);
  EXPECT_LT(nees, 5 * 1.4);
}

TEST(RelativePose, OfAnyRotationOfACarIsRecoveredBySinglePoints) {
  Random random = seeded_random(73);
  for (int run = 0; run < 60; ++run) {
    const double yaw = random.uniform(-0.3, 0.3);
    const double path = (run % 2 ? 1 : -1) * random.uniform(0.5, 2);
    const SE3 level =
        pose({0, yaw, 0}, path * Eigen::Vector3d(std::sin(yaw / 2), 0, std::cos(yaw / 2)));
    const SE3 T_level_cam = pose(random_vector(0.2, random), {0, 0, 0});
    const SE3 truth = T_level_cam.inverse() * level * T_level_cam;
    const PointScene scene = make_scene(kCamera, {SE3(), truth}, 50, random);
    ASSERT_EQ(scene.points_ref.size(), 50u);
    const auto result =
        estimate_circular_motion(kCamera, scene.px[0], scene.px[1], T_level_cam.rotation(), {});
    ASSERT_TRUE(result.outcome) << run << ": " << result.outcome.reason;
    EXPECT_NEAR(result.yaw_rad, yaw, 1e-6) << run;
    EXPECT_LT(angle_between(result.T_ref_cur.translation(), truth.translation()), 1e-5) << run;
  }
}

TEST(RelativePose, OfAnyTwoCloudsIsRecoveredAndSwappedIsItsInverse) {
  Random random = seeded_random(74);
  for (int run = 0; run < 60; ++run) {
    const SE3 truth = pose(random_vector(2, random), random_vector(10, random));
    std::vector<CloudPoint> ref, cur;
    for (int i = 0; i < 30; ++i) {
      const Eigen::Vector3d p = random_vector(10, random);
      const Eigen::Vector3d spread = random_vector(0.1, random);
      const Eigen::Matrix3d covariance =
          spread * spread.transpose() + 1e-3 * Eigen::Matrix3d::Identity();
      ref.push_back({p, covariance});
      cur.push_back({truth.inverse() * p, covariance});
    }
    const auto forth = estimate_pose_3d3d(ref, cur, {}, random);
    const auto back = estimate_pose_3d3d(cur, ref, {}, random);
    ASSERT_TRUE(forth.outcome) << run << ": " << forth.outcome.reason;
    ASSERT_TRUE(back.outcome) << run;
    EXPECT_LT((truth.inverse() * forth.T_ref_cur).log().norm(), 1e-6) << run;
    EXPECT_LT((back.T_ref_cur * forth.T_ref_cur).log().norm(), 1e-6) << run;
  }
}

}  // namespace relative_pose_test
}  // namespace placegraph
