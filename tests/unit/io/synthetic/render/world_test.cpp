#include <gtest/gtest.h>
#include <placegraph/io/synthetic/render/undulation.h>
#include <placegraph/io/synthetic/render/world.h>

#include <cmath>
#include <set>
#include <string>

#include "tests/support/seed.h"

namespace placegraph::synthetic {
namespace world_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

Footprint random_footprint(Random& random) {
  const double angle = random.uniform(-3, 3);
  return {{random.uniform(-4, 4), random.uniform(-4, 4)},
          {std::cos(angle), std::sin(angle)},
          random.uniform(0.5, 3),
          random.uniform(0.5, 3)};
}

/// A point of a rectangle by its shares of the half sides.
Vector2d point_of(const Footprint& f, double along, double across) {
  return f.centre + along * f.half_length * f.axis +
         across * f.half_width * Vector2d(-f.axis[1], f.axis[0]);
}

TEST(Footprint, HasTheDistanceToItsNearestPoint) {
  Random random = test::seeded_random(41);
  for (int trial = 0; trial < 100; ++trial) {
    const Footprint f = random_footprint(random);
    const Vector2d p(random.uniform(-9, 9), random.uniform(-9, 9));
    double nearest = 1e9;
    constexpr int kSteps = 60;
    for (int i = -kSteps; i <= kSteps; ++i)
      for (int k = -kSteps; k <= kSteps; ++k)
        nearest = std::min(nearest, (point_of(f, 1.0 * i / kSteps, 1.0 * k / kSteps) - p).norm());
    EXPECT_LE(f.distance(p), nearest + 1e-9);
    EXPECT_GE(f.distance(p), nearest - 3.0 / kSteps);  // half a cell of the grid, up to 0.035 m
  }
}

TEST(Footprint, OverlapsWhereAPointLiesInBoth) {
  Random random = test::seeded_random(42);
  int overlapping = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Footprint a = random_footprint(random), b = random_footprint(random);
    EXPECT_EQ(a.overlaps(b), b.overlaps(a));
    bool shared = false;  // points of a in b, on a grid; what it misses is a narrow overlap
    double nearest = 1e9;
    for (int i = -20; i <= 20; ++i)
      for (int k = -20; k <= 20; ++k) {
        const double distance = b.distance(point_of(a, i / 20.0, k / 20.0));
        shared = shared || distance == 0;
        nearest = std::min(nearest, distance);
      }
    if (shared) {
      EXPECT_TRUE(a.overlaps(b));
    } else if (nearest > 0.11) {  // half a cell of at most 0.15 m by 0.15 m
      EXPECT_FALSE(a.overlaps(b));
    }
    overlapping += shared;
  }
  EXPECT_GE(overlapping, 50);
}

TEST(WorldParts, ABoxIsClosedButForItsFloorAndLooksOutwards) {
  Random random = test::seeded_random(43);
  for (int trial = 0; trial < 50; ++trial) {
    const double angle = random.uniform(-3, 3);
    const Vector3d x(std::cos(angle), 0, std::sin(angle)), z(-std::sin(angle), 0, std::cos(angle));
    const Vector3d base(random.normal(), random.normal(), random.normal()),
        size(random.uniform(0.1, 5), random.uniform(0.1, 5), random.uniform(0.1, 5));
    Part part;
    add_box(part, base, x, random.index(2) == 0 ? z : Vector3d(-z), size, Material::kMasonry,
            Material::kRoof, SurfaceClass::kBuilding, 7);
    part.finish();
    ASSERT_EQ(part.faces.size(), 5u);
    const Vector3d middle = base - Vector3d(0, size[1] / 2, 0);
    EXPECT_LT((part.centre - middle).norm(), 1e-9);
    EXPECT_GE(part.radius, 0.5 * size.norm() - 1e-9);
    Vector3d areas = Vector3d::Zero();  // of a closed surface they sum to zero
    for (const Face& face : part.faces) {
      const double area = (face.corners[1] - face.corners[0])
                              .cross(face.corners[2] - face.corners[0])
                              .norm();
      areas += area * face.normal;
      EXPECT_GT(face.normal.dot(face.corners[0] - middle), 0);
      EXPECT_NEAR(face.normal.dot(face.corners[2] - face.corners[0]), 0, 1e-9);
      EXPECT_NEAR(face.s_axis.cross(face.t_axis).dot(face.normal), 1, 1e-9);
      EXPECT_NEAR(face.width * face.height, area, 1e-5 * area);
    }
    EXPECT_LT((areas - Vector3d(0, -size[0] * size[2], 0)).norm(), 1e-9);
  }
}

TEST(WorldParts, PlanesHoldTheirPointsAndTheirNumbersFit16Bits) {
  Random random = test::seeded_random(44);
  Scene scene;
  for (int i = 1; i < 65535; ++i) {
    const Vector3d normal(0.6, 0, 0.8), p(random.normal(), random.normal(), random.normal());
    ASSERT_EQ(scene.add_plane(normal, p), i);
    ASSERT_NEAR(scene.planes.back().head<3>().dot(p), scene.planes.back()[3], 1e-12);
  }
  EXPECT_EQ(scene.add_plane(Vector3d::UnitX(), Vector3d::Zero()), 0);
  EXPECT_EQ(scene.planes.size(), 65535u);
}

TEST(WorldParts, ClassesHaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (int i = 0; i < static_cast<int>(SurfaceClass::kCount); ++i)
    names.insert(to_string(static_cast<SurfaceClass>(i)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(SurfaceClass::kCount));
}

TEST(RoadUndulation, HasTheHeightsThatAreAskedFor) {
  for (const double rms_m : {0.02, 0.1}) {
    const Undulation undulation(rms_m, 5);
    double squares = 0, steepest = 0;
    int count = 0;
    for (double x = 0; x < 400; x += 1.7)
      for (double z = 0; z < 400; z += 1.7, ++count) {
        const double height = undulation.height(x, z);
        squares += height * height;
        steepest = std::max(steepest, std::abs(undulation.height(x + 0.01, z) - height) / 0.01);
      }
    // Thirteen of the longest waves across the area: their share of the variance is known to 10 %.
    EXPECT_NEAR(std::sqrt(squares / count), rms_m, 0.1 * rms_m);
    EXPECT_LT(steepest, 3 * rms_m);  // no jumps
    EXPECT_NE(undulation.height(3, 4), Undulation(rms_m, 6).height(3, 4));
  }
  EXPECT_TRUE(Undulation(0, 5).empty());
  EXPECT_EQ(Undulation().height(1, 2), 0);
}

}  // namespace world_test
}  // namespace placegraph::synthetic
