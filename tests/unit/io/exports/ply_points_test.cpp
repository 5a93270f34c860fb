#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/ply_points.h>
#include <placegraph/io/measurements/point_cloud_file.h>

#include <cstring>
#include <limits>

#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace ply_points_test {

const std::vector<ColouredPoint> kTwo = {
    {{1.5, -2.25, 1e-3}, {255, 0, 17}, 0.125},
    {{0.1, 0.2, 30}, {1, 2, 3}, std::numeric_limits<double>::quiet_NaN()}};

TEST(PlyPoints, AreReadBackInBothForms) {
  const test::TemporaryFolder dir;
  for (const NumberForm form : {NumberForm::kBinary, NumberForm::kText}) {
    const PointCloud cloud = read_point_cloud(dir.write("p.ply", to_ply(kTwo, form, {"a map"})));
    ASSERT_EQ(cloud.points.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_TRUE(cloud.points[i].isApprox(kTwo[i].position, 1e-7)) << i;
  }
}

TEST(PlyPoints, HaveColoursAndDeviations) {
  const std::string text = to_ply(kTwo, NumberForm::kText, {"a map"});
  EXPECT_THAT(text, testing::HasSubstr("comment a map\nelement vertex 2\n"));
  EXPECT_THAT(text, testing::EndsWith("property float sigma_m\nend_header\n"
                                      "1.5 -2.25 0.001 255 0 17 0.125\n0.1 0.2 30 1 2 3 nan\n"));
  const std::string binary = to_ply(kTwo, NumberForm::kBinary);
  const std::string end = "end_header\n";
  const std::size_t begin = binary.find(end) + end.size();
  ASSERT_EQ(binary.size(), begin + 2 * 19);
  EXPECT_EQ(binary.substr(begin + 12, 3), std::string("\xff\x00\x11", 3));
  float sigma = 0;
  std::memcpy(&sigma, binary.data() + begin + 15, sizeof sigma);
  EXPECT_EQ(sigma, 0.125F);
}

TEST(PlyPoints, TakeNoCommentOfTwoLines) {
  EXPECT_THROW(to_ply(std::vector<ColouredPoint>(), NumberForm::kText, {"a\nend_header"}), ArgumentError);
}

}  // namespace ply_points_test
}  // namespace placegraph
