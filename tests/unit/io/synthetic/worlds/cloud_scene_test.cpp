#include <gtest/gtest.h>
#include <placegraph/io/synthetic/worlds/cloud_scene.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/seed.h"

namespace placegraph::synthetic {
namespace cloud_scene_test {

using Eigen::Vector3d;

Vector3d random_vector(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// A solid before the sensor, or around it if it is a room.
Solid random_solid(SolidKind kind, Random& random, int first_label) {
  const bool room = kind == SolidKind::kRoom;
  const Vector3d at = room ? random_vector(random, 0.5)
                           : Vector3d(random.uniform(-1, 1), random.uniform(-1, 1),
                                      random.uniform(4, 6));
  const double least = room ? 2 : 0.4, most = room ? 5 : 1.5;
  return {kind, SE3(SO3::exp(random_vector(random, 2)), at),
          {random.uniform(least, most), random.uniform(least, most), random.uniform(least, most)},
          first_label};
}

constexpr SolidKind kKinds[] = {SolidKind::kBox, SolidKind::kRoom, SolidKind::kBall,
                                SolidKind::kCylinder};

/// The surface of a solid at a point of it, in its own frame: the number of its plane from 1 on,
/// 0 if curved, nothing if the point is off the surface.
std::optional<int> surface_at(const Solid& solid, const Vector3d& p_sensor) {
  const Vector3d p = (solid.T_sensor_solid.inverse() * p_sensor).cwiseQuotient(solid.half);
  constexpr double kRounding = 1e-9;
  if (solid.kind == SolidKind::kBall)
    return std::abs(p.norm() - 1) < kRounding ? std::optional(0) : std::nullopt;
  if (solid.kind == SolidKind::kCylinder) {
    const double radius = p.head<2>().norm();
    if (std::abs(radius - 1) < kRounding && std::abs(p.z()) < 1 + kRounding) return 0;
    if (std::abs(std::abs(p.z()) - 1) > kRounding || radius > 1 + kRounding) return std::nullopt;
    return p.z() < 0 ? 1 : 2;
  }
  int axis = 0;
  if (std::abs(p.cwiseAbs().maxCoeff(&axis) - 1) > kRounding) return std::nullopt;
  return 2 * axis + (p[axis] < 0 ? 1 : 2);
}

TEST(CloudScene, PointsLieOnTheSurfaceThatTheirLabelNamesAndOnTheirRay) {
  Random random = test::seeded_random(61);
  CloudSensor sensor;
  sensor.width = 31;
  sensor.height = 21;
  sensor.focal_px = 40;
  for (int trial = 0; trial < 40; ++trial) {
    const SolidKind kind = kKinds[trial % 4];
    const Solid solid = random_solid(kind, random, 5);
    const LabelledCloud taken = take_cloud({solid}, sensor, random);
    ASSERT_EQ(taken.cloud.points.size(), 31u * 21u);
    ASSERT_EQ(taken.labels.size(), taken.cloud.points.size());
    int hits = 0;
    for (std::size_t i = 0; i < taken.labels.size(); ++i) {
      const Vector3d& p = taken.cloud.points[i];
      if (!p.allFinite()) {
        EXPECT_EQ(taken.labels[i], 0);
        continue;
      }
      ++hits;
      EXPECT_NEAR(40 * p.x() / p.z(), static_cast<int>(i) % 31 - 15, 1e-9);
      EXPECT_NEAR(40 * p.y() / p.z(), static_cast<int>(i) / 31 - 10, 1e-9);
      const std::optional<int> surface = surface_at(solid, p);
      ASSERT_TRUE(surface);
      EXPECT_EQ(taken.labels[i], *surface > 0 ? 5 + *surface - 1 : 0);
      if (kind == SolidKind::kRoom) continue;  // else the side that faces the sensor
      const Vector3d before = 0.999 * p;
      const auto inside = [&](const Vector3d& q) {
        const Vector3d s = (solid.T_sensor_solid.inverse() * q).cwiseQuotient(solid.half);
        if (kind == SolidKind::kBall) return s.norm() < 1;
        if (kind == SolidKind::kBox) return s.cwiseAbs().maxCoeff() < 1;
        return s.head<2>().norm() < 1 && std::abs(s.z()) < 1;
      };
      EXPECT_FALSE(inside(before));
    }
    EXPECT_TRUE(kind == SolidKind::kRoom ? hits == 31 * 21 : hits >= 20) << hits;
  }
}

TEST(CloudScene, EveryRayEndsAtTheNearestOfAllSolids) {
  Random random = test::seeded_random(62);
  CloudSensor sensor;
  sensor.width = sensor.height = 25;
  sensor.focal_px = 30;
  for (int trial = 0; trial < 15; ++trial) {
    std::vector<Solid> solids;
    for (int i = 0; i < 6; ++i)
      solids.push_back(random_solid(kKinds[random.index(4)], random, 1 + 10 * i));
    const LabelledCloud all = take_cloud(solids, sensor, random);
    std::vector<double> depth(625, std::numeric_limits<double>::infinity());
    std::vector<int> label(625, 0);
    for (const Solid& solid : solids) {
      const LabelledCloud one = take_cloud({solid}, sensor, random);
      for (std::size_t i = 0; i < 625; ++i)
        if (one.cloud.points[i].z() < depth[i]) {
          depth[i] = one.cloud.points[i].z();
          label[i] = one.labels[i];
        }
    }
    for (std::size_t i = 0; i < 625; ++i) {
      EXPECT_EQ(all.labels[i], label[i]);
      EXPECT_EQ(std::isfinite(all.cloud.points[i].z()), std::isfinite(depth[i]));
      if (std::isfinite(depth[i])) {
        EXPECT_EQ(all.cloud.points[i].z(), depth[i]);
      }
    }
  }
}

TEST(CloudScene, AScanIsEvenInAzimuthAndElevationAndHasNoImage) {
  Random random = test::seeded_random(63);
  CloudSensor sensor;
  sensor.scans = true;
  sensor.width = 40;
  sensor.height = 20;
  sensor.step_rad = 0.05;
  const Solid room = random_solid(SolidKind::kRoom, random, 1);
  const LabelledCloud taken = take_cloud({room}, sensor, random);
  EXPECT_EQ(taken.cloud.width, 0);
  ASSERT_EQ(taken.cloud.points.size(), 800u);
  for (std::size_t i = 0; i < 800; ++i) {
    const Vector3d& p = taken.cloud.points[i];
    EXPECT_NEAR(std::atan2(p.x(), p.z()), 0.05 * (static_cast<int>(i) % 40 - 19.5), 1e-9);
    EXPECT_NEAR(std::asin(p.y() / p.norm()), 0.05 * (static_cast<int>(i) / 40 - 9.5), 1e-9);
  }
  const Solid ball{SolidKind::kBall, SE3(SO3(), Vector3d(0, 0, 5)), {1, 1, 1}};
  const LabelledCloud few = take_cloud({ball}, sensor, random);
  for (const Vector3d& p : few.cloud.points) EXPECT_TRUE(p.allFinite());  // what is missed is out
  // A ball of 1 m in 5 m is a cone of asin(0.2), its solid angle filled by steps of 0.05.
  const double expected = std::numbers::pi * std::pow(std::asin(0.2) / 0.05, 2);
  EXPECT_NEAR(static_cast<double>(few.labels.size()), expected, 8);  // half of those on the rim
}

TEST(CloudScene, NoiseLiesAlongTheRayAndGrowsByItsPower) {
  Random random = test::seeded_random(64);
  const auto wall_at = [](double z) {
    return Solid{SolidKind::kBox, SE3(SO3(), Vector3d(0, 0, z + 1)), {100, 100, 1}};
  };
  for (const double power : {0.0, 1.0, 2.0})
    for (const double distance : {2.0, 8.0}) {
      CloudSensor sensor;
      sensor.noise_share = 0.01;
      sensor.noise_power = power;
      sensor.depth_scale_m = 4;
      const LabelledCloud taken = take_cloud({wall_at(distance)}, sensor, random);
      double squares = 0;
      for (std::size_t i = 0; i < taken.labels.size(); ++i) {
        const Vector3d& p = taken.cloud.points[i];
        squares += std::pow(p.z() - distance, 2);
        ASSERT_NEAR(150 * p.x() / p.z(), static_cast<int>(i) % 160 - 79.5, 1e-9);
      }
      // 19200 samples: their deviation is known to 0.5 %.
      const double sigma = std::sqrt(squares / static_cast<double>(taken.labels.size()));
      EXPECT_NEAR(sigma / (0.04 * std::pow(distance / 4, power)), 1, 0.025);
    }
}

TEST(CloudScene, ARandomCloudIsThatOfItsSeed) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Random first(seed), again(seed);
    const LabelledCloud a = random_cloud(first), b = random_cloud(again);
    ASSERT_EQ(a.labels, b.labels);
    ASSERT_EQ(a.cloud.points.size(), a.labels.size());
    for (std::size_t i = 0; i < a.labels.size(); ++i)
      ASSERT_TRUE(a.cloud.points[i] == b.cloud.points[i] || !a.cloud.points[i].allFinite());
    if (a.cloud.width > 0) {
      EXPECT_EQ(a.labels.size(), static_cast<std::size_t>(a.cloud.width * a.cloud.height));
    }
  }
}

}  // namespace cloud_scene_test
}  // namespace placegraph::synthetic
