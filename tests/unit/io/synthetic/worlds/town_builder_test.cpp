#include <gtest/gtest.h>
#include <placegraph/io/synthetic/worlds/town_builder.h>

#include <algorithm>
#include <cmath>

#include "tests/support/seed.h"

namespace placegraph::synthetic {
namespace town_builder_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A straight street of 120 m along z that is driven on its right lane, and then on the pavement
/// at its left.
TownPlan plan_of(std::uint64_t seed) {
  Roadway street;
  for (int z = 0; z <= 120; z += 2) street.centre.emplace_back(0, z);
  std::vector<Vector2d> driven;
  for (double z = 5; z < 115; z += 0.5) driven.emplace_back(1.75, z);
  for (double z = 40; z < 80; z += 0.5) driven.emplace_back(-5.5, z);
  const GroundMesh flat(HeightSurface::from_function({-200, -200}, {200, 320}, 50,
                                                     [](double, double) { return 0.0; }));
  return {{street}, flat, driven, seed};
}

std::vector<Vector2d> corners_of(const Footprint& f) {
  const Vector2d along = f.half_length * f.axis,
                 across = f.half_width * Vector2d(-f.axis[1], f.axis[0]);
  return {f.centre + along + across, f.centre + along - across, f.centre - along + across,
          f.centre - along - across};
}

TEST(TownBuilder, SolidsKeepOffTheAsphaltAndTheDrivenPath) {
  for (const std::uint64_t seed : {1, 2}) {
    const TownPlan plan = plan_of(seed);
    const Scene scene = build_town(plan);
    EXPECT_GE(scene.solids.size(), 20u);
    for (const Footprint& solid : scene.solids) {
      for (const Vector2d& p : corners_of(solid))
        EXPECT_GE(scene.road->edge_distance(p[0], p[1]), 0) << p.transpose();
      for (const Vector2d& p : plan.driven)
        ASSERT_GE(solid.distance(p), kCarHalfWidth_m + kClearance_m);
    }
  }
}

TEST(TownBuilder, TheSameSeedIsTheSameTown) {
  const Scene a = build_town(plan_of(1)), b = build_town(plan_of(1)), c = build_town(plan_of(2));
  ASSERT_EQ(a.parts.size(), b.parts.size());
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    ASSERT_EQ(a.parts[i].centre, b.parts[i].centre);
    ASSERT_EQ(a.parts[i].faces.front().seed, b.parts[i].faces.front().seed);
  }
  EXPECT_NE(a.seed, c.seed);
}

TEST(TownBuilder, FacesLieInTheirPlanesAndPartsInTheirSpheres) {
  const Scene scene = build_town(plan_of(1));
  std::size_t listed = 0;
  for (const Part& part : scene.parts)
    for (const Face& face : part.faces) {
      ASSERT_NEAR(face.normal.norm(), 1, 1e-9);
      const Eigen::Vector4d& plane = scene.planes.at(static_cast<std::size_t>(face.plane));
      for (int i = 0; i < face.count; ++i) {
        const Vector3d& p = face.corners[static_cast<std::size_t>(i)];
        ASSERT_LE((p - part.centre).norm(), part.radius + 1e-9);
        if (face.plane > 0) {
          ASSERT_NEAR(plane.head<3>().dot(p), plane[3], 1e-6);
        }
      }
      listed += face.plane > 0;
    }
  EXPECT_GE(listed, 100u);
}

TEST(TownBuilder, AStationLiesOnTheRoadAndPointsToItsSide) {
  Random random = test::seeded_random(72);
  Roadway roadway;
  Vector2d at(3, -4);
  double walked = 0;
  for (int i = 0; i < 40; ++i) {
    roadway.centre.push_back(at);
    const double angle = 0.05 * i, step = random.uniform(1, 3);
    at += step * Vector2d(std::sin(angle), std::cos(angle));
    if (i < 39) walked += step;
  }
  EXPECT_NEAR(length(roadway), walked, 1e-9);
  for (int trial = 0; trial < 100; ++trial) {
    const double s = random.uniform(0, walked);
    const auto left = station(roadway, s, -1), right = station(roadway, s, 1);
    ASSERT_TRUE(left && right);
    EXPECT_EQ(left->centre, right->centre);
    EXPECT_EQ(left->outward, -right->outward);
    EXPECT_NEAR(right->along.dot(right->outward), 0, 1e-12);
    // x right, z forward: the right side lies clockwise of the way.
    EXPECT_NEAR(right->along[1] * right->outward[0] - right->along[0] * right->outward[1], 1, 1e-9);
    const auto further = station(roadway, std::min(s + 1e-4, walked), 1);
    EXPECT_NEAR((further->centre - right->centre).norm(), std::min(1e-4, walked - s), 1e-9);
  }
  EXPECT_FALSE(station(roadway, walked + 0.01, 1));
}

TEST(TownBuilder, AMovedPartHasItsShapeAndTheLightOfItsNewNormals) {
  const Part car = make_car(5);
  const SE3 T(SO3::exp(Vector3d(0.1, 2, -0.2)), Vector3d(10, 1, -7));
  const Part moved = transformed(car, T);
  ASSERT_EQ(moved.faces.size(), car.faces.size());
  for (std::size_t i = 0; i < car.faces.size(); ++i) {
    const Face &from = car.faces[i], &to = moved.faces[i];
    for (std::size_t k = 0; k < static_cast<std::size_t>(from.count); ++k)
      EXPECT_LT((T * from.corners[k] - to.corners[k]).norm(), 1e-12);
    // Coordinates on the surface stay, so that the texture moves along.
    const Vector3d &p = from.corners[2], &q = to.corners[2];
    EXPECT_NEAR(from.s_axis.dot(p - from.origin), to.s_axis.dot(q - to.origin), 1e-9);
    EXPECT_NEAR(from.t_axis.dot(p - from.origin), to.t_axis.dot(q - to.origin), 1e-9);
    EXPECT_EQ(to.light, outdoor_light(to.normal));
  }
}

TEST(TownBuilder, ACarHasTheSizeOfOneAndStandsOnTheGround) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    Vector3d low = Vector3d::Constant(9), high = -low;
    for (const Face& face : make_car(seed).faces)
      for (int i = 0; i < face.count; ++i) {
        low = low.cwiseMin(face.corners[static_cast<std::size_t>(i)]);
        high = high.cwiseMax(face.corners[static_cast<std::size_t>(i)]);
      }
    const Vector3d size = high - low;
    EXPECT_NEAR(size.x(), 1.7, 0.3);
    EXPECT_NEAR(size.z(), 4.2, 0.6);
    EXPECT_NEAR(-low.y(), 1.45, 0.25);
    EXPECT_NEAR(high.y(), 0, 0.05);
    EXPECT_NEAR(low.x() + high.x(), 0, 1e-9);
  }
}

}  // namespace town_builder_test
}  // namespace placegraph::synthetic
