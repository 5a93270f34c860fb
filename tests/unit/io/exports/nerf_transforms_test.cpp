#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/nerf_transforms.h>

#include <nlohmann/json.hpp>
#include <numbers>

namespace placegraph {
namespace nerf_transforms_test {

TEST(NerfTransforms, HaveTheCameraAndItsPosesInOpenGlsAxes) {
  const Camera camera{640, 480, 500, 501, 319.5, 239.5, Distortion::kNone, {}};
  const SO3 quarter = SO3::exp(Eigen::Vector3d(0, std::numbers::pi / 2, 0));  // z to x
  const auto json = nlohmann::json::parse(
      to_nerf_transforms(camera, {{"../a/0.png", SE3()}, {"b.png", SE3(quarter, {1, 2, 3})}}));
  EXPECT_EQ(json["fl_x"], 500);
  EXPECT_EQ(json["fl_y"], 501);
  EXPECT_EQ(json["cx"], 320);
  EXPECT_EQ(json["cy"], 240);
  EXPECT_EQ(json["w"], 640);
  EXPECT_EQ(json["h"], 480);
  ASSERT_EQ(json["frames"].size(), 2u);
  EXPECT_EQ(json["frames"][0]["file_path"], "../a/0.png");
  const auto at = [&](int frame, int row, int column) {
    return json["frames"][frame]["transform_matrix"][row][column].get<double>();
  };
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      EXPECT_EQ(at(0, i, j), i != j ? 0 : i == 1 || i == 2 ? -1 : 1) << i << j;
  // The camera looks along its -z axis: along x of the world.
  EXPECT_NEAR(-at(1, 0, 2), 1, 1e-12);
  EXPECT_NEAR(at(1, 1, 1), -1, 1e-12);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(at(1, i, 3), i + 1, 1e-12);
  EXPECT_EQ(at(1, 3, 3), 1);
}

TEST(NerfTransforms, TakeNoDistortion) {
  Camera camera{640, 480, 500, 501, 319.5, 239.5, Distortion::kEquidistant, {}};
  EXPECT_THROW(to_nerf_transforms(camera, {}), ArgumentError);
}

}  // namespace nerf_transforms_test
}  // namespace placegraph
