#include <gtest/gtest.h>
#include <placegraph/io/synthetic/worlds/town_builder.h>
#include <placegraph/io/synthetic/worlds/traffic.h>

#include <algorithm>
#include <cmath>

#include "tests/support/seed.h"

namespace placegraph::synthetic {
namespace traffic_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

GroundMesh slope(double rise_x, double rise_z) {
  return GroundMesh(HeightSurface::from_function(
      {-300, -300}, {300, 900}, 10,
      [=](double x, double z) { return -(rise_x * x + rise_z * z); }));
}

/// A camera that drives along z at 10 m/s for a minute, 1.65 m above a level ground.
struct Drive {
  GroundMesh ground = slope(0, 0);
  std::vector<double> time_s;
  std::vector<SE3> T_scene_cam;
  Drive() {
    for (int i = 0; i < 600; ++i) {
      time_s.push_back(0.1 * i);
      T_scene_cam.emplace_back(SO3(), Vector3d(0, -1.65, i));
    }
  }
};

TEST(Traffic, ACarStandsOnTheSlopeBelowIt) {
  Random random = test::seeded_random(71);
  for (int trial = 0; trial < 50; ++trial) {
    const double rise_x = random.uniform(-0.1, 0.1), rise_z = random.uniform(-0.1, 0.1);
    const double angle = random.uniform(-3, 3);
    const Vector2d at(random.uniform(-50, 50), random.uniform(-50, 50)),
        direction(std::cos(angle), std::sin(angle));
    const SE3 T = car_pose(slope(rise_x, rise_z), at, direction);
    EXPECT_LT((T.translation() - Vector3d(at[0], -(rise_x * at[0] + rise_z * at[1]), at[1])).norm(),
              1e-6);
    const Eigen::Matrix3d R = T.rotation().matrix();
    const double rise = rise_x * direction[0] + rise_z * direction[1];
    EXPECT_NEAR(-R(1, 2) / std::hypot(R(0, 2), R(2, 2)), rise, 1e-6);
    EXPECT_NEAR(R.col(2).dot(Vector3d(direction[0], 0, direction[1])), std::hypot(R(0, 2), R(2, 2)),
                1e-9);
    EXPECT_NEAR(R(1, 0), 0, 1e-9);  // its wheels left and right are at one height
    EXPECT_GT(R(1, 1), 0.9);
  }
}

TEST(Traffic, ComesTowardsTheCameraOnItsLeftOrDrivesAheadAndKeepsClear) {
  const Drive drive;
  int oncoming = 0, ahead = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scene scene;
    add_traffic(scene, drive.ground, drive.time_s, drive.T_scene_cam, 12, seed);
    // One car every five seconds, jittered by a half: 10 to 20 a minute but for the first seconds.
    EXPECT_GE(scene.movers.size(), 6u);
    EXPECT_LE(scene.movers.size(), 20u);
    for (const MovingObject& mover : scene.movers) {
      std::optional<Vector3d> last;
      for (std::size_t i = 0; i < drive.time_s.size(); ++i) {
        const auto T = mover.T_scene_object(drive.time_s[i]);
        if (!T) continue;
        const Vector3d p = T->translation(), z = T->rotation().matrix().col(2);
        const bool comes = z.z() < 0;
        EXPECT_NEAR(p.x(), comes ? -3.4 : 0, 0.05);
        EXPECT_NEAR(p.y(), 0, 1e-6);
        const Vector3d off = p - drive.T_scene_cam[i].translation();
        const double gap = std::hypot(off.x(), off.z());
        EXPECT_GT(gap, comes ? 3.3 : 13.9);  // a lane beside it, or 14 m ahead
        if (last) {
          EXPECT_GT((p - *last).dot(z), 0);  // it drives forwards
        }
        if (last && comes) {
          EXPECT_NEAR((p - *last).norm(), 0.8, 0.02);
        }
        last = p;
        ++(comes ? oncoming : ahead);
      }
    }
  }
  EXPECT_GE(oncoming, 100);
  EXPECT_GE(ahead, 100);
}

TEST(Traffic, IsNoneWithoutARateOrAPath) {
  const Drive drive;
  Scene scene;
  add_traffic(scene, drive.ground, drive.time_s, drive.T_scene_cam, 0, 1);
  add_traffic(scene, drive.ground, {0}, {SE3()}, 10, 1);
  const std::vector<SE3> standing(600, drive.T_scene_cam.front());
  add_traffic(scene, drive.ground, drive.time_s, standing, 10, 1);
  EXPECT_TRUE(scene.movers.empty());
}

TEST(Traffic, ACrossingCarPassesItsPointInTimeUnlessTheCameraIsThere) {
  const Drive drive;
  Scene scene;
  const Vector2d crossing(0, 300), direction(1, 0);
  // The camera is there after 30 s: a car then would hit it, one five seconds later does not.
  EXPECT_FALSE(add_crossing_car(scene, drive.ground, drive.time_s, drive.T_scene_cam, crossing,
                                direction, 30, 9, 5));
  EXPECT_TRUE(scene.movers.empty());
  ASSERT_TRUE(add_crossing_car(scene, drive.ground, drive.time_s, drive.T_scene_cam, crossing,
                               direction, 35, 9, 5));
  ASSERT_EQ(scene.movers.size(), 1u);
  const auto& pose = scene.movers[0].T_scene_object;
  EXPECT_LT((pose(35)->translation() - Vector3d(0, 0, 300)).norm(), 1e-6);
  EXPECT_LT((pose(37)->translation() - Vector3d(18, 0, 300)).norm(), 1e-6);
  EXPECT_FALSE(pose(35 - 66 / 9.0));
  EXPECT_TRUE(pose(35 + 64 / 9.0));
  EXPECT_FALSE(pose(35 + 66 / 9.0));
}

}  // namespace traffic_test
}  // namespace placegraph::synthetic
