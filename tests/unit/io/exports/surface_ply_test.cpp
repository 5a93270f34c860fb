#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/surface_ply.h>

#include <cstring>

#include "tests/support/message_of.h"

namespace placegraph {
namespace surface_ply_test {

using testing::HasSubstr;

TEST(SurfacePly, PointsHaveNormalsColoursAndCounts) {
  const std::vector<DensePoint> points = {{{1, 2, 3.5}, {0, 0, -1}, {7, 8, 255}, 12}};
  EXPECT_EQ(to_ply(points, NumberForm::kText, {"a cloud"}),
            "ply\nformat ascii 1.0\ncomment a cloud\nelement vertex 1\nproperty float x\n"
            "property float y\nproperty float z\nproperty float nx\nproperty float ny\n"
            "property float nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
            "property int pixels\nend_header\n1 2 3.5 0 0 -1 7 8 255 12\n");
  const std::string binary = to_ply(points, NumberForm::kBinary);
  const std::size_t begin = binary.find("end_header\n") + 11;
  ASSERT_EQ(binary.size() - begin, 6 * 4 + 3 + 4u);
  float z = 0;
  std::int32_t count = 0;
  std::memcpy(&z, binary.data() + begin + 8, 4);
  std::memcpy(&count, binary.data() + begin + 27, 4);
  EXPECT_EQ(z, 3.5F);
  EXPECT_EQ(count, 12);
}

TriangleMesh triangle() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals.assign(3, {0, 0, 1});
  mesh.rgb.assign(3, {1, 2, 3});
  mesh.faces = {{0, 1, 2}};
  return mesh;
}

TEST(SurfacePly, MeshesHaveFaces) {
  const std::string text = to_ply(triangle(), NumberForm::kText);
  EXPECT_THAT(text, HasSubstr("element vertex 3\n"));
  EXPECT_THAT(text, HasSubstr("element face 1\nproperty list uchar int vertex_indices\n"));
  EXPECT_THAT(text, HasSubstr("end_header\n0 0 0 0 0 1 1 2 3\n"));
  EXPECT_TRUE(text.ends_with("3 0 1 2\n"));
  const std::string binary = to_ply(triangle(), NumberForm::kBinary);
  EXPECT_EQ(binary.size() - binary.find("end_header\n") - 11, 3 * 27 + 13u);
}

TEST(SurfacePly, CommentsAreOneLine) {
  EXPECT_THAT(test::message_of<ArgumentError>(
                  [] { to_ply(triangle(), NumberForm::kText, {"two\nlines"}); }),
              HasSubstr("a comment is one line"));
}

}  // namespace surface_ply_test
}  // namespace placegraph
