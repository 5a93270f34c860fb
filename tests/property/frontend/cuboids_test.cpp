// Boxes and rooms of generated scenes, as a depth camera sees them.
#include <gtest/gtest.h>
#include <placegraph/frontend/cloud_planes/cuboids.h>
#include <placegraph/frontend/cloud_planes/planarity_model.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/io/synthetic/worlds/cloud_scene.h>

#include <algorithm>
#include <iostream>
#include <map>

#include "tests/support/seed.h"

namespace placegraph {
namespace cuboids_test {

using synthetic::LabelledCloud;
using synthetic::Solid;
using synthetic::SolidKind;

/// A room with boxes turned anyhow on its floor, a ball now and then; the camera is held anyhow.
std::vector<Solid> furnished_room(Random& random) {
  const SO3 R_sensor_level = SO3::exp({random.uniform(-0.3, 0.5), 0, 0}) *
                             SO3::exp({0, random.uniform(-std::numbers::pi, std::numbers::pi), 0});
  const Eigen::Vector3d half(random.uniform(2, 5), random.uniform(1.2, 1.6), random.uniform(2, 6));
  const Eigen::Vector3d middle(random.uniform(-0.6, 0.6) * half.x(), random.uniform(-0.2, 0.4),
                               random.uniform(-0.6, 0.6) * half.z());
  const double floor_y = middle.y() + half.y();
  std::vector<Solid> solids{{.kind = SolidKind::kRoom,
                             .T_sensor_solid = SE3(R_sensor_level, R_sensor_level * middle),
                             .half = half,
                             .first_label = 1}};
  const auto ahead = [&](double height) {  // somewhere before the camera, on the floor
    Eigen::Vector3d p = R_sensor_level.inverse() * Eigen::Vector3d(random.uniform(-0.5, 0.5), 0, 1);
    p.y() = 0;
    p *= random.uniform(1.5, 3) / p.norm();
    p.y() = floor_y - height;
    return p;
  };
  for (int b = random.index(4); b > 0; --b) {
    Solid box;
    box.first_label = 6 * static_cast<int>(solids.size()) + 1;
    for (int i = 0; i < 3; ++i) box.half[i] = random.uniform(0.15, 0.6);
    const SO3 R =
        R_sensor_level * SO3::exp({0, random.uniform(-std::numbers::pi, std::numbers::pi), 0});
    box.T_sensor_solid = SE3(R, R_sensor_level * ahead(box.half.y()));
    solids.push_back(box);
  }
  if (random.index(2) == 0) {
    Solid ball;
    ball.kind = SolidKind::kBall;
    ball.half.setConstant(0.3);
    ball.T_sensor_solid = SE3(R_sensor_level, R_sensor_level * ahead(0.3));
    solids.push_back(ball);
  }
  return solids;
}

/// Whether every face of a cuboid is one of the solid's.
bool is_of(const Cuboid& cuboid, const Solid& solid, const CloudPlanesResult& planes,
           const LabelledCloud& seen) {
  if ((cuboid.kind == CuboidKind::kBox) != (solid.kind == SolidKind::kBox)) return false;
  for (const int face : cuboid.faces) {
    if (face < 0) continue;
    std::map<int, int> labels;
    for (std::size_t i = 0; i < planes.labels.size(); ++i)
      if (planes.labels[i] == face + 1) ++labels[seen.labels[i]];
    if (labels.empty()) return false;
    const auto most = std::max_element(labels.begin(), labels.end(),
                                       [](auto& a, auto& b) { return a.second < b.second; });
    if (most->first < solid.first_label || most->first >= solid.first_label + 6) return false;
  }
  return true;
}

/// The largest angle between an axis of a cuboid and the solid's nearest one [deg].
double rotation_deg(const Cuboid& cuboid, const Solid& solid) {
  const Eigen::Matrix3d cosines = (cuboid.T_sensor_cuboid.rotation().matrix().transpose() *
                                   solid.T_sensor_solid.rotation().matrix())
                                      .cwiseAbs();
  return rad_to_deg(std::acos(std::min(1.0, cosines.rowwise().maxCoeff().minCoeff())));
}

/// How far the middle of every seen side is from the nearest of the solid's sides [m].
void add_sides_off(const Cuboid& cuboid, const Solid& solid, std::vector<double>& off_m) {
  for (std::size_t side = 0; side < cuboid.faces.size(); ++side) {
    if (cuboid.faces[side] < 0) continue;
    const auto axis = static_cast<Eigen::Index>(side / 2);
    const Eigen::Vector3d on =
        (side % 2 == 0 ? -1 : 1) * cuboid.half[axis] * Eigen::Vector3d::Unit(axis);
    const Eigen::Vector3d in_solid = solid.T_sensor_solid.inverse() * (cuboid.T_sensor_cuboid * on);
    off_m.push_back((in_solid.cwiseAbs() - solid.half).cwiseAbs().minCoeff());
  }
}

TEST(Cuboids, OfFurnishedRoomsAreFoundAndHardlyAnyOther) {
  Random random = test::seeded_random(5);
  constexpr int kScenes = 40, kFewest = 150;
  int boxes = 0, boxes_found = 0, rooms = 0, rooms_found = 0, found = 0, right = 0;
  std::vector<double> rotations_deg, sides_m;
  for (int k = 0; k < kScenes; ++k) {
    const std::vector<Solid> solids = furnished_room(random);
    const LabelledCloud seen = synthetic::take_cloud(
        solids,
        {.width = 320, .height = 240, .focal_px = 250, .noise_share = 0.002, .noise_power = 2},
        random);
    const CloudPlanesResult planes = find_cloud_planes(seen.cloud, {}, built_in_planarity());
    const std::vector<Cuboid> cuboids = find_cuboids(seen.cloud, planes, {});
    found += static_cast<int>(cuboids.size());
    for (const Solid& solid : solids) {
      if (solid.kind == SolidKind::kBall) continue;
      int faces = 0;
      for (int f = 0; f < 6; ++f)
        faces +=
            std::count(seen.labels.begin(), seen.labels.end(), solid.first_label + f) >= kFewest;
      const auto it = std::find_if(cuboids.begin(), cuboids.end(), [&](const Cuboid& cuboid) {
        return is_of(cuboid, solid, planes, seen);
      });
      const bool there = it != cuboids.end();
      right += there;
      if (there) {
        rotations_deg.push_back(rotation_deg(*it, solid));
        add_sides_off(*it, solid, sides_m);
      }
      if (faces < 3) continue;
      (solid.kind == SolidKind::kBox ? boxes : rooms) += 1;
      (solid.kind == SolidKind::kBox ? boxes_found : rooms_found) += there;
    }
  }
  ASSERT_GE(boxes, 8);
  ASSERT_GE(rooms, 12);
  ASSERT_FALSE(rotations_deg.empty());
  std::sort(rotations_deg.begin(), rotations_deg.end());
  std::sort(sides_m.begin(), sides_m.end());
  std::cout << boxes_found << " of " << boxes << " boxes and " << rooms_found << " of " << rooms
            << " rooms with three faces found; " << right << " of " << found
            << " cuboids right, turned by " << rotations_deg[rotations_deg.size() / 2]
            << " deg (median), seen sides off by " << sides_m[sides_m.size() / 2]
            << " m (median)\n";
  EXPECT_LT(sides_m[sides_m.size() / 2], 0.01);
  EXPECT_GE(boxes_found, 0.85 * boxes);
  EXPECT_GE(rooms_found, 0.7 * rooms);
  EXPECT_GE(right, 0.9 * found);
  EXPECT_LT(rotations_deg[rotations_deg.size() / 2], 0.3);
}

}  // namespace cuboids_test
}  // namespace placegraph
