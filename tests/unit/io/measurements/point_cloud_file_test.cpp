#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/io/measurements/point_cloud_file.h>

#include <cstring>
#include <limits>
#include <opencv2/core.hpp>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace point_cloud_file_test {

using ::testing::HasSubstr;

std::string bytes_of(const std::vector<float>& values) {
  std::string bytes(values.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::string message(const std::string& path) {
  return test::message_of([&] { (void)read_point_cloud(path); });
}

const std::string kHeader =
    "ply\nformat binary_little_endian 1.0\ncomment made by hand\nelement vertex 2\n"
    "property float x\nproperty float y\nproperty uchar red\nproperty float z\nelement face 0\n"
    "property list uchar int vertex_indices\nend_header\n";

std::string vertex(float x, float y, float z) { return bytes_of({x, y}) + '\x7f' + bytes_of({z}); }

TEST(PointCloudFile, ReadsTextWithOrWithoutLabels) {
  test::TemporaryFolder dir;
  const PointCloud cloud = read_point_cloud(dir.write("a.txt", "# x y z\n1 2 3 7\n-1 0.5 2e1 8\n"));
  ASSERT_EQ(cloud.points.size(), 2u);
  EXPECT_FALSE(cloud.organised());
  EXPECT_EQ(cloud.points[1], Eigen::Vector3d(-1, 0.5, 20));
  EXPECT_THAT(message(dir.write("b.txt", "1 2 3\n1 2\n")), HasSubstr("b.txt:2: 2 columns"));
  EXPECT_THAT(message(dir.write("c.txt", "1 2 nan\n")), HasSubstr("c.txt:1: z"));
  EXPECT_THAT(message(dir.write("d.txt", "1 2 1e9\n")), HasSubstr("d.txt:1: z"));
  EXPECT_THAT(message(dir.write("e.txt", "# nothing\n")), HasSubstr("no point"));
  EXPECT_THAT(message(dir / "none.txt"), HasSubstr("none.txt"));
  EXPECT_THAT(message(dir.path()), HasSubstr("folder"));
}

TEST(PointCloudFile, TakesTheSensorsOwnPositionAsNoMeasurement) {
  test::TemporaryFolder dir;
  const PointCloud cloud = read_point_cloud(dir.write("a.txt", "0 0 0\n1 2 3\n-0 0 0\n0 0 1\n"));
  ASSERT_EQ(cloud.points.size(), 4u);  // labels of the file stay in step with its lines
  EXPECT_FALSE(cloud.points[0].allFinite());
  EXPECT_FALSE(cloud.points[2].allFinite());
  EXPECT_EQ(cloud.points[3], Eigen::Vector3d(0, 0, 1));
}

TEST(PointCloudFile, ReadsKittiScans) {
  test::TemporaryFolder dir;
  const PointCloud cloud =
      read_point_cloud(dir.write("a.bin", bytes_of({1, 2, 3, 0.5f, 4, 5, 6, 0})));
  ASSERT_EQ(cloud.points.size(), 2u);
  EXPECT_EQ(cloud.points[1], Eigen::Vector3d(4, 5, 6));
  EXPECT_THAT(message(dir.write("b.bin", bytes_of({1, 2, 3}))), HasSubstr("12 bytes"));
  EXPECT_THAT(message(dir.write("c.bin", "")), HasSubstr("no point"));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(message(dir.write("d.bin", bytes_of({1, 2, 3, 0, 1, nan, 3, 0}))),
              HasSubstr("point 1 is not finite"));
}

TEST(PointCloudFile, ReadsPlyInBothForms) {
  test::TemporaryFolder dir;
  const PointCloud binary =
      read_point_cloud(dir.write("a.ply", kHeader + vertex(1, 2, 3) + vertex(4, 5, 6)));
  ASSERT_EQ(binary.points.size(), 2u);
  EXPECT_EQ(binary.points[1], Eigen::Vector3d(4, 5, 6));
  const std::string ascii =
      "ply\r\nformat ascii 1.0\r\nelement vertex 2\r\nproperty double z\r\nproperty double x\r\n"
      "property double y\r\nend_header\r\n3 1 2\r\n6 4 5\r\n";
  EXPECT_EQ(read_point_cloud(dir.write("b.ply", ascii)).points, binary.points);
}

TEST(PointCloudFile, RefusesBrokenPly) {
  test::TemporaryFolder dir;
  const auto broken = [&](const std::string& text) { return message(dir.write("x.ply", text)); };
  EXPECT_THAT(broken(kHeader + vertex(1, 2, 3)), HasSubstr("truncated"));
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_THAT(broken(kHeader + vertex(1, 2, 3) + vertex(1, 2, inf)), HasSubstr("point 1"));
  EXPECT_THAT(broken("PLY\n"), HasSubstr("x.ply:1: "));
  EXPECT_THAT(broken("ply\nformat ascii 1.0\n"), HasSubstr("end_header"));
  EXPECT_THAT(broken("ply\n" + std::string(1 << 20, 'a')), HasSubstr("end_header"));
  EXPECT_THAT(broken("ply\nformat binary_big_endian 1.0\nend_header\n"), HasSubstr("x.ply:2: "));
  EXPECT_THAT(broken("ply\nformat ascii 1.0\nelement vertex -4\nend_header\n"),
              HasSubstr("is not a count"));
  EXPECT_THAT(broken("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"),
              HasSubstr("without x, y and z"));
  const std::string xyz = "property float x\nproperty float y\nproperty float z\nend_header\n";
  EXPECT_THAT(broken("ply\nformat ascii 1.0\nelement vertex 3\n" + xyz + "1 2 3\n"),
              HasSubstr("truncated: 1 vertices of 3"));
  EXPECT_THAT(broken("ply\nformat ascii 1.0\nelement vertex 1\n" + xyz + "1 2\n"),
              HasSubstr("x.ply:8: 2 columns"));
  EXPECT_THAT(broken("ply\nformat binary_little_endian 1.0\nelement vertex 9000000000000000000\n" +
                     xyz + "abc"),
              HasSubstr("truncated"));
  EXPECT_THAT(broken("ply\nelement vertex 1\n" + xyz + "1 2 3\n"), HasSubstr("no format"));
}

TEST(PointCloudFile, MakesAnOrganisedCloudOfADepthImage) {
  const Camera camera{.width = 3, .height = 2, .fx = 2, .fy = 2, .cx = 1, .cy = 0};
  Image depth = Image::zeros(2, 3, CV_32FC1);
  depth.at<float>(1, 2) = 4;
  const PointCloud cloud = cloud_of_depth(depth, camera, 0.001);
  ASSERT_EQ(cloud.points.size(), 6u);
  EXPECT_TRUE(cloud.organised());
  EXPECT_FALSE(cloud.points[0].allFinite());
  EXPECT_EQ(cloud.points[5], Eigen::Vector3d(2, 2, 4));
  EXPECT_THROW((void)cloud_of_depth(Image::zeros(3, 3, CV_32FC1), camera, 0), ArgumentError);
}

TEST(PointCloudFile, ReadsLabelsInEitherForm) {
  test::TemporaryFolder dir;
  EXPECT_EQ(read_point_labels(dir.write("a.txt", "3\n0\n12\n")), (std::vector<int>{3, 0, 12}));
  EXPECT_EQ(read_point_labels(dir.write("b.txt", "1 2 3 4\n5 6 7 8\n")), (std::vector<int>{4, 8}));
  for (const char* text : {"1 2\n", "a\n", "-1\n", "1.5\n"})
    EXPECT_THAT(test::message_of([&] { (void)read_point_labels(dir.write("c.txt", text)); }),
                HasSubstr("c.txt:1: "));
}

}  // namespace point_cloud_file_test
}  // namespace placegraph
