#include <gtest/gtest.h>
#include <placegraph/frontend/cloud_planes/cuboids.h>
#include <placegraph/frontend/cloud_planes/planarity_model.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <limits>

#include "tests/support/scenes/clouds.h"

namespace placegraph {
namespace cuboids_test {

using test::look_at;
using test::Seen;
using test::SeenCloud;

struct Found {
  CloudPlanesResult planes;
  std::vector<Cuboid> cuboids;
};

Found find(const SeenCloud& seen, const CuboidOptions& options = {}) {
  Found found;
  found.planes = find_cloud_planes(seen.cloud, {}, built_in_planarity());
  found.cuboids = find_cuboids(seen.cloud, found.planes, options);
  return found;
}

int faces_seen(const Cuboid& cuboid) {
  return static_cast<int>(
      std::count_if(cuboid.faces.begin(), cuboid.faces.end(), [](int f) { return f >= 0; }));
}

const SO3 kRotation = SO3::exp({0.5, 0, 0}) * SO3::exp({0, 0.6, 0});
const Eigen::Vector3d kMiddle(0.1, 0, 2.2), kHalf(0.4, 0.3, 0.5);

/// A box in the air before a far wall.
Seen see_box(const Eigen::Vector3d& ray) {
  const Eigen::Vector3d from = kRotation.inverse() * -kMiddle, path = kRotation.inverse() * ray;
  double enter = 0, leave = 1e9;
  int label = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (-kHalf[axis] - from[axis]) / path[axis],
                 b = (kHalf[axis] - from[axis]) / path[axis];
    if (std::min(a, b) > enter) enter = std::min(a, b), label = axis + 1;
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave ? Seen{enter, label} : Seen{6, 4};
}

TEST(Cuboids, ABoxHasItsPlaceAndItsSides) {
  const Found found = find(look_at(see_box, 1, 1e-3));
  ASSERT_EQ(found.cuboids.size(), 1u);
  const Cuboid& box = found.cuboids[0];
  EXPECT_EQ(box.kind, CuboidKind::kBox);
  EXPECT_EQ(faces_seen(box), 3);
  EXPECT_LT((box.T_sensor_cuboid.translation() - kMiddle).norm(), 0.02);
  for (int i = 0; i < 3; ++i) {
    Eigen::Index which = 0;
    const double cosine =
        (kRotation.matrix().transpose() * box.T_sensor_cuboid.rotation().matrix().col(i))
            .cwiseAbs()
            .maxCoeff(&which);
    EXPECT_GT(cosine, 0.9999);
    EXPECT_NEAR(box.half[i], kHalf[which], 0.02);
  }
  EXPECT_GT(box.T_sensor_cuboid.rotation().matrix().determinant(), 0.999);
}

TEST(Cuboids, ACornerIsARoom) {
  const Found found = find(look_at(test::see_corner, 1, 1e-3));
  ASSERT_EQ(found.cuboids.size(), 1u);
  const Cuboid& room = found.cuboids[0];
  EXPECT_EQ(room.kind, CuboidKind::kRoom);
  EXPECT_EQ(faces_seen(room), 3);
  // Its seen sides hold the planes they are told to be.
  for (std::size_t side = 0; side < 6; ++side) {
    if (room.faces[side] < 0) continue;
    const Plane& plane = found.planes.planes[static_cast<std::size_t>(room.faces[side])].plane;
    Eigen::Vector3d on = Eigen::Vector3d::Zero();
    const auto axis = static_cast<Eigen::Index>(side / 2);
    on[axis] = (side % 2 == 0 ? -1 : 1) * room.half[axis];
    EXPECT_NEAR(plane.normal.dot(room.T_sensor_cuboid * on), plane.distance_m, 0.01);
  }
  EXPECT_TRUE(find(look_at(test::see_corner, 1, 1e-3), {.min_room_faces = 4}).cuboids.empty());
}

TEST(Cuboids, PlanesThatDoNotTouchAreNone) {
  // Three boards at right angles with air between them.
  const auto boards = [](const Eigen::Vector3d& ray) {
    const Seen seen = test::see_corner(ray);
    const Eigen::Vector3d p = seen.depth * ray;
    int near = 0;
    for (const auto& plane : {Eigen::Vector4d(0, 1, 0, 0.8), Eigen::Vector4d(0.6, 0, 0.8, 2.4),
                              Eigen::Vector4d(-0.8, 0, 0.6, 2.0)})
      near += std::abs(plane.head<3>().dot(p) - plane[3]) < 0.25;
    return near > 1 ? Seen{9, 5} : seen;
  };
  const Found found = find(look_at(boards, 1, 1e-3));
  EXPECT_GE(found.planes.planes.size(), 3u);
  EXPECT_TRUE(found.cuboids.empty());
}

TEST(Cuboids, ThereAreNoneWithoutPlanes) {
  const SeenCloud seen = look_at(test::see_corner, 1, 1e-3);
  CloudPlanesResult planes;
  planes.labels.assign(seen.cloud.points.size(), 0);
  EXPECT_TRUE(find_cuboids(seen.cloud, planes, {}).empty());
}

TEST(Cuboids, PointsThatAreNotThereDoNotCount) {
  SeenCloud seen = look_at(test::see_corner, 1, 1e-3);
  const CloudPlanesResult planes = find_cloud_planes(seen.cloud, {}, built_in_planarity());
  for (std::size_t i = 0; i < seen.cloud.points.size(); i += 7)
    seen.cloud.points[i].setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(find_cuboids(seen.cloud, planes, {}).size(), 1u);
}

TEST(Cuboids, LabelsMustFitThePoints) {
  const SeenCloud seen = look_at(test::see_corner, 1, 1e-3);
  CloudPlanesResult planes = find_cloud_planes(seen.cloud, {}, built_in_planarity());
  planes.labels.pop_back();
  EXPECT_THROW((void)find_cuboids(seen.cloud, planes, {}), ArgumentError);
  planes.labels.push_back(static_cast<int>(planes.planes.size()) + 1);
  EXPECT_THROW((void)find_cuboids(seen.cloud, planes, {}), ArgumentError);
  planes.labels.back() = 0;
  EXPECT_NO_THROW((void)find_cuboids(seen.cloud, planes, {}));
  planes.from_origin = false;
  EXPECT_THROW((void)find_cuboids(seen.cloud, planes, {}), ArgumentError);
  CuboidOptions options;
  options.gap = 0;
  EXPECT_THROW(options.check(), ArgumentError);
}

}  // namespace cuboids_test
}  // namespace placegraph
