#include <gtest/gtest.h>
#include <placegraph/io/synthetic/worlds/indoor_walk.h>
#include <placegraph/io/synthetic/worlds/small_room.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace placegraph::synthetic {
namespace indoor_walk_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

BuildingLayout hall() {
  BuildingLayout plan;
  plan.rooms.push_back({"hall", {0, 0}, {20, 30}, 3, 0});
  plan.add_ring({0, 0}, {20, 30}, 3);
  return plan;
}

/// A walk up the hall and to its right side.
IndoorWalk walk() {
  IndoorWalk walk;
  walk.corners = {{4, 3}, {4, 23}, {16, 23}};
  walk.speed_mps = 1.2;
  walk.camera_height_m = 1.5;
  return walk;
}

Tour tour_of(const IndoorWalk& walk, std::uint32_t seed) {
  Tour tour;
  walk_through(hall(), walk, seed, tour);
  return tour;
}

TEST(IndoorWalk, BeginsWithTheAxesOfTheSceneAndStaysAtItsHeight) {
  const Tour tour = tour_of(walk(), 3);
  ASSERT_EQ(tour.time_s.size(), tour.T_scene_cam.size());
  EXPECT_EQ(tour.camera_height_m, 1.5);
  const SE3& first = tour.T_scene_cam.front();
  EXPECT_LT((first.rotation().matrix() - Eigen::Matrix3d::Identity()).norm(), 1e-9);
  EXPECT_LT((first.translation() - Vector3d(4, -1.5, 3)).norm(), 1e-9);
  for (std::size_t i = 0; i < tour.time_s.size(); ++i) {
    EXPECT_NEAR(tour.time_s[i], 0.1 * static_cast<double>(i), 1e-12);
    EXPECT_EQ(tour.T_scene_cam[i].translation().y(), -1.5);
  }
  EXPECT_LT((tour.T_scene_cam.back().translation() - Vector3d(16, -1.5, 23)).norm(), 0.2);
}

TEST(IndoorWalk, KeepsToItsPathAndSpeedAndSwaysALittle) {
  const Tour tour = tour_of(walk(), 4);
  double fastest = 0;
  for (std::size_t i = 1; i < tour.time_s.size(); ++i) {
    const Vector3d p = tour.T_scene_cam[i].translation(),
                   step = p - tour.T_scene_cam[i - 1].translation();
    fastest = std::max(fastest, step.norm() / 0.1);
    // The path is rounded within half a window beside its corner, and the sway is of 2 cm.
    const double off = std::min(std::abs(p.x() - 4), std::abs(p.z() - 23));
    EXPECT_LT(off, std::hypot(p.x() - 4, p.z() - 23) < 1.6 ? 0.5 : 0.0201) << i;
    const Eigen::Matrix3d R = tour.T_scene_cam[i].rotation().matrix();
    EXPECT_LT(std::abs(R(1, 2)), 0.032);  // pitch
    EXPECT_LT(std::abs(R(1, 0)), 0.022);  // roll
    const Vector3d ahead = p.x() < 5 ? Vector3d::UnitZ() : Vector3d::UnitX();
    if (std::hypot(p.x() - 4, p.z() - 23) > 2.5) {
      EXPECT_GT(R.col(2).dot(ahead), std::cos(0.07));
    }
  }
  EXPECT_LT(fastest, 1.2 + 0.1);  // the sway across it adds little
  EXPECT_GT(fastest, 1.2 - 0.05);
}

TEST(IndoorWalk, ItsPlanIsInTheFrameOfTheFirstPose) {
  const auto json = nlohmann::json::parse(tour_of(walk(), 5).floor_plan);
  EXPECT_DOUBLE_EQ(json["floor_y"], 1.5);
  EXPECT_NEAR(json["rooms"][0]["low"][0], -4, 1e-9);
  EXPECT_NEAR(json["rooms"][0]["low"][1], -3, 1e-9);
}

TEST(IndoorWalk, AnotherSeedIsAnotherSwayOnTheSameWay) {
  const Tour a = tour_of(walk(), 6), same = tour_of(walk(), 6), b = tour_of(walk(), 7);
  ASSERT_EQ(a.time_s.size(), b.time_s.size());
  double most = 0;
  for (std::size_t i = 0; i < a.time_s.size(); ++i) {
    EXPECT_EQ(a.T_scene_cam[i].translation(), same.T_scene_cam[i].translation());
    most = std::max(most, (a.T_scene_cam[i].translation() - b.T_scene_cam[i].translation()).norm());
  }
  EXPECT_GT(most, 0.005);
  EXPECT_LT(most, 0.0401);
}

/// Corners of a footprint.
std::vector<Vector2d> corners_of(const Footprint& f) {
  const Vector2d along = f.half_length * f.axis,
                 across = f.half_width * Vector2d(-f.axis[1], f.axis[0]);
  return {f.centre + along + across, f.centre + along - across, f.centre - along + across,
          f.centre - along - across};
}

TEST(SmallRoom, FurnitureStandsAlongTheWallsAndLeavesTheMiddleFree) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Scene scene;
    scene.outdoor = false;
    Random random(seed);
    const SmallRoom room = build_small_room(scene, random);
    EXPECT_TRUE(room.size[0] >= 4.6 && room.size[0] <= 5.4);
    EXPECT_TRUE(room.size[1] >= 3.8 && room.size[1] <= 4.4);
    int pieces = 0;
    for (const Footprint& solid : scene.solids) {
      const bool wall = solid.half_length > 1.5 && solid.half_width < 0.1;
      pieces += !wall;
      for (const Vector2d& p : corners_of(solid)) {
        const double to_wall = std::min(p.minCoeff(), (room.size - p).minCoeff());
        // A wall is 0.16 m thick; a piece stands 2 cm off it, and some are turned a little.
        EXPECT_GT(to_wall, wall ? -0.081 : 0.03) << seed;
        EXPECT_LT(to_wall, SmallRoom::kFurnitureDepth_m + 0.081 + 0.02 + 0.05) << seed;
      }
    }
    EXPECT_GE(pieces, 20);
    for (const Part& part : scene.parts)
      for (const Face& face : part.faces)
        for (int i = 0; i < face.count; ++i) {
          const Vector3d& p = face.corners[static_cast<std::size_t>(i)];
          EXPECT_TRUE(p.y() <= 1e-9 && p.y() >= -room.height_m - 1e-9) << seed;
        }
  }
}

TEST(SmallRoom, IsThatOfItsSeed) {
  Scene a, b, c;
  Random first(3), again(3), other(4);
  build_small_room(a, first);
  build_small_room(b, again);
  build_small_room(c, other);
  ASSERT_EQ(a.solids.size(), b.solids.size());
  for (std::size_t i = 0; i < a.solids.size(); ++i)
    EXPECT_EQ(a.solids[i].centre, b.solids[i].centre);
  EXPECT_NE(a.solids.back().centre, c.solids.back().centre);
}

}  // namespace indoor_walk_test
}  // namespace placegraph::synthetic
