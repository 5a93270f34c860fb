#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/dense/voxel_cloud.h>

#include <limits>
#include <set>

#include "tests/support/message_of.h"
#include "tests/unit/pipeline/dense/rendered_depth.h"

namespace placegraph {
namespace voxel_cloud_test {

using test::message_of;
using test::rendered_depth;
using testing::HasSubstr;

KeyframeDepth sphere_from(const SE3& T_map_cam) {
  KeyframeDepth depth = rendered_depth(T_map_cam, 0.001, test::sphere_depth);
  estimate_normals(depth, 2, 0.2);
  return depth;
}

TEST(VoxelCloud, HasAPointAVoxelOnTheSurface) {
  VoxelCloud cloud(0.05);
  for (const SE3& T_map_cam : test::poses_around(6)) cloud.add(sphere_from(T_map_cam));
  const std::vector<DensePoint> points = cloud.points(2);
  EXPECT_GT(points.size(), 1000u);
  std::set<std::array<int, 3>> voxels;
  for (const DensePoint& point : points) {
    EXPECT_NEAR(point.position.norm(), 1, 0.01);
    EXPECT_NEAR(point.normal.norm(), 1, 1e-5);
    EXPECT_GT(point.normal.cast<double>().dot(point.position), 0.97);
    EXPECT_EQ(point.rgb, (std::array<std::uint8_t, 3>{30, 20, 10}));
    EXPECT_GE(point.pixels, 2);
    std::array<int, 3> voxel{};
    for (int i = 0; i < 3; ++i)
      voxel[static_cast<std::size_t>(i)] = static_cast<int>(std::floor(point.position[i] / 0.05));
    EXPECT_TRUE(voxels.insert(voxel).second);
  }
  EXPECT_GT(cloud.points(1).size(), points.size());
}

TEST(VoxelCloud, WeighsDepthsByTheirInformation) {
  VoxelCloud cloud(1);
  KeyframeDepth near = rendered_depth(SE3(), 0.01, [](const auto&, const auto&) { return 2.2; });
  KeyframeDepth far = rendered_depth(SE3(), 0.02, [](const auto&, const auto&) { return 2.8; });
  for (KeyframeDepth* depth : {&near, &far}) {
    estimate_normals(*depth, 2, 0.1);
    const cv::Mat one = depth->depth(cv::Rect(80, 60, 1, 1)).clone();
    depth->depth.setTo(0);
    one.copyTo(depth->depth(cv::Rect(80, 60, 1, 1)));
    cloud.add(*depth);
  }
  const double a = 1 / std::pow(0.01 * 2.2 * 2.2, 2), b = 1 / std::pow(0.02 * 2.8 * 2.8, 2);
  const std::vector<DensePoint> points = cloud.points(1);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].position[2], (2.2 * a + 2.8 * b) / (a + b), 1e-4);
}

TEST(VoxelCloud, RefusesVoxelsThatAreNoneOrTooMany) {
  for (const double side : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity()})
    EXPECT_THAT(message_of<ArgumentError>([&] { VoxelCloud cloud(side); }),
                HasSubstr("the side must be positive"));
  VoxelCloud small(0.001, 10000);
  EXPECT_THAT(message_of<ArgumentError>([&] {
                small.add(sphere_from(SE3(SO3(), {0, 0, -3})));
              }),
              HasSubstr("too small for the memory"));
  VoxelCloud tiny(1e-12);
  EXPECT_THAT(message_of<ArgumentError>([&] {
                tiny.add(sphere_from(SE3(SO3(), {0, 0, -3})));
              }),
              HasSubstr("too small for the extent"));
}

}  // namespace voxel_cloud_test
}  // namespace placegraph
