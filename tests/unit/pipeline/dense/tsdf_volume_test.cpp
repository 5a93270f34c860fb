#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/dense/mesh_parts.h>
#include <placegraph/pipeline/dense/tsdf_surface.h>

#include <Eigen/Geometry>
#include <map>

#include "tests/support/message_of.h"
#include "tests/unit/pipeline/dense/rendered_depth.h"

namespace placegraph {
namespace tsdf_volume_test {

using test::message_of;
using test::rendered_depth;
using testing::HasSubstr;

TriangleMesh mesh_of_sphere() {
  TsdfVolume volume(0.04);
  for (const SE3& T_map_cam : test::poses_around(8)) {
    KeyframeDepth depth = rendered_depth(T_map_cam, 0.001, test::sphere_depth);
    estimate_normals(depth, 2, 0.2);
    volume.add(depth);
  }
  return surface_of(volume);
}

TEST(TsdfVolume, MeshOfASphereIsOnItAndFacesOutwards) {
  const TriangleMesh mesh = mesh_of_sphere();
  ASSERT_GT(mesh.faces.size(), 2000u);
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  // The cameras are around the equator: the poles are seen at grazing angles.
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_EQ(mesh.rgb[i], (std::array<std::uint8_t, 3>{30, 20, 10}));
    if (std::abs(mesh.positions[i][1]) > 0.6) continue;
    EXPECT_NEAR(mesh.positions[i].norm(), 1, 0.0125);
    EXPECT_GT(mesh.normals[i].cast<double>().dot(mesh.positions[i]), 0.95);
  }
  for (const auto& face : mesh.faces) {
    const Eigen::Vector3d a = mesh.positions[static_cast<std::size_t>(face[0])];
    const Eigen::Vector3d b = mesh.positions[static_cast<std::size_t>(face[1])];
    const Eigen::Vector3d c = mesh.positions[static_cast<std::size_t>(face[2])];
    if (std::abs(a[1]) < 0.6) {
      EXPECT_GE((b - a).cross(c - a).dot(a), -1e-9);
    }
  }
}

TEST(TsdfVolume, TrianglesShareVerticesAndNoEdgeHasThree) {
  const TriangleMesh mesh = mesh_of_sphere();
  std::map<std::pair<int, int>, int> edges;
  for (const auto& face : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{face[k], face[(k + 1) % 3]}];
  std::size_t open = 0;
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);  // the other triangle of an edge has it the other way round
    open += edges.count({edge.second, edge.first}) == 0;
  }
  EXPECT_LT(open, edges.size() / 10);  // the poles were not seen
}

TEST(TsdfVolume, DistanceIsAlongTheNormal) {
  const Eigen::Vector3d plane(0.3, -0.2, 0.5);  // plane . p = 1
  KeyframeDepth depth = rendered_depth(
      SE3(), 0.001, [&](const auto&, const auto& ray) { return 1 / plane.dot(ray); });
  estimate_normals(depth, 3, 0.1);
  TsdfVolume volume(0.05);
  volume.add(depth);
  int seen = 0;
  for (int x = -5; x <= 5; ++x)
    for (int z = 20; z < 60; ++z)
      if (const TsdfVoxel* voxel = volume.find({x, 0, z}); voxel && voxel->weight > 0) {
        const Eigen::Vector3d p(0.05 * x, 0, 0.05 * z);
        const double distance = (1 - plane.dot(p)) / plane.norm();
        EXPECT_NEAR(voxel->distance, std::min(distance, volume.truncation()), 1e-3);
        ++seen;
      }
  EXPECT_GT(seen, 50);
}

TEST(TsdfVolume, RefusesMoreThanTheMemory) {
  KeyframeDepth depth = rendered_depth(SE3(), 0.001, test::plane_depth);
  estimate_normals(depth, 3, 0.1);
  TsdfVolume volume(0.01, 100000);
  EXPECT_THAT(message_of<ArgumentError>([&] { volume.add(depth); }),
              HasSubstr("too small for the memory"));
}

TEST(MeshParts, SmallOnesAreRemoved) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0},   {0, 2, 0},  {2, 2, 0},
                    {5, 0, 0}, {5.5, 0, 0}, {5, 0.5, 0}};
  mesh.rgb.resize(7);
  mesh.rgb[1] = {1, 2, 3};
  mesh.faces = {{4, 5, 6}, {0, 1, 2}, {1, 3, 2}};
  mesh.normals = vertex_normals(mesh);
  for (const Eigen::Vector3f& normal : mesh.normals) EXPECT_EQ(normal, Eigen::Vector3f(0, 0, 1));
  remove_small_parts(mesh, 1);
  ASSERT_EQ(mesh.faces.size(), 2u);
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.rgb[static_cast<std::size_t>(mesh.faces[0][1])][2], 3);
  remove_small_parts(mesh, 5);
  EXPECT_TRUE(mesh.positions.empty());
}

}  // namespace tsdf_volume_test
}  // namespace placegraph
