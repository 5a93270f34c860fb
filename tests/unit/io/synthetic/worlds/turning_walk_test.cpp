#include <placegraph/io/synthetic/worlds/synthetic_world.h>
#include <placegraph/io/synthetic/worlds/tours.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/clean_world.h"

namespace placegraph::synthetic {
namespace turning_walk_test {

constexpr double kDegree = std::numbers::pi / 180;

Tour walk(std::uint64_t seed) {
  TourRequest request;
  request.seed = seed;
  return make_turning_walk(request);
}

double rotation_between(const Tour& tour, std::size_t i) {
  return (tour.T_scene_cam[i].rotation().inverse() * tour.T_scene_cam[i + 1].rotation())
      .log()
      .norm();
}

TEST(TurningWalk, RotatesFarAndFastAtPlacesThatItHardlyLeaves) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Tour tour = walk(seed);
    EXPECT_GT(tour.T_scene_cam.size(), 800U);
    EXPECT_LT(tour.T_scene_cam.size(), 1600U);
    double path_m = 0, rotated = 0, fastest = 0;
    std::vector<double> speed;  // of the camera while it turns quickly
    for (std::size_t i = 0; i + 1 < tour.T_scene_cam.size(); ++i) {
      const double step =
          (tour.T_scene_cam[i + 1].translation() - tour.T_scene_cam[i].translation()).norm();
      const double rotation = rotation_between(tour, i);
      path_m += step;
      rotated += rotation;
      fastest = std::max(fastest, 30 * rotation);
      if (30 * rotation > 35 * kDegree) speed.push_back(30 * step);
    }
    EXPECT_GT(rotated, 600 * kDegree) << seed;
    EXPECT_GT(fastest, 45 * kDegree) << seed;
    EXPECT_LT(fastest, 130 * kDegree) << seed;
    EXPECT_LT(path_m, 8) << seed;
    // A hand's breadth off the axis: 0.08 m at 80 degrees a second is 0.11 m/s.
    std::nth_element(speed.begin(), speed.begin() + static_cast<std::ptrdiff_t>(speed.size() / 2),
                     speed.end());
    EXPECT_LT(speed[speed.size() / 2], 0.12) << seed;
    EXPECT_GT(speed[speed.size() / 2], 0.02) << seed;
  }
}

TEST(TurningWalk, BeginsLevelAndMovesSmoothly) {
  const Tour tour = walk(3);
  EXPECT_LT(tour.T_scene_cam.front().rotation().log().norm(), 1e-12);
  for (std::size_t i = 1; i + 1 < tour.T_scene_cam.size(); ++i) {
    const Eigen::Vector3d bend = tour.T_scene_cam[i + 1].translation() -
                                 2 * tour.T_scene_cam[i].translation() +
                                 tour.T_scene_cam[i - 1].translation();
    ASSERT_LT(bend.norm() * 900, 6) << i;  // [m/s^2]
  }
}

TEST(TurningWalk, KeepsClearOfTheFurniture) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Tour tour = walk(seed);
    double nearest = 10;
    for (std::size_t i = 0; i < tour.T_scene_cam.size(); i += 5) {
      const Eigen::Vector3d p = tour.T_scene_cam[i].translation();
      for (const Footprint& solid : tour.scene.solids)
        nearest = std::min(nearest, solid.distance({p[0], p[2]}));
    }
    EXPECT_GT(nearest, 0.25) << seed;
  }
}

TEST(TurningWalk, IsDecidedByItsSeed) {
  const Tour a = walk(4), b = walk(4), c = walk(5);
  ASSERT_EQ(a.T_scene_cam.size(), b.T_scene_cam.size());
  EXPECT_EQ(a.T_scene_cam[500].matrix(), b.T_scene_cam[500].matrix());
  EXPECT_EQ(a.scene.parts.size(), b.scene.parts.size());
  EXPECT_NE(a.T_scene_cam[500].matrix(), c.T_scene_cam[500].matrix());
  EXPECT_NE(a.scene.parts.size(), c.scene.parts.size());
}

TEST(TurningWalk, SeesDepthsOfADeskAndOfARoom) {
  const SyntheticWorld world(test::clean_world("turning-walk", 0, 80, 60));
  SyntheticContents contents;
  contents.depth = true;
  std::vector<float> depths;
  for (std::size_t i = 0; i < world.size(); i += 25) {
    const Image depth = world.render(i, contents).frame.depth;
    for (int v = 0; v < depth.rows; ++v)
      for (int u = 0; u < depth.cols; ++u) depths.push_back(depth.at<float>(v, u));
  }
  std::sort(depths.begin(), depths.end());
  EXPECT_GT(depths.front(), 0.3F);  // walls all around: no pixel without depth
  EXPECT_LT(depths[depths.size() / 100], 1.3F);
  EXPECT_GT(depths[depths.size() * 9 / 10], 2.2F);
  EXPECT_LT(depths.back(), 6.5F);
  EXPECT_FALSE(world.calibration().camera_height_m);  // it changes
  EXPECT_TRUE(world.is_indoor());
}

}  // namespace turning_walk_test
}  // namespace placegraph::synthetic
