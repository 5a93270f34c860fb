#include <gtest/gtest.h>
#include <placegraph/frontend/features/depth_lookup.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/scenes/texture.h"

namespace placegraph {
namespace depth_lookup_test {

using namespace test;
const Camera kCamera = pinhole(160, 120, 130);

/// A depth camera beside the colour camera, turned a little, of another focal length.
DepthCamera beside() {
  return {pinhole(160, 120, 150), pose({0.01, -0.02, 0.01}, {0.04, -0.01, 0.02}), 0.005};
}

Image depth_image(const DepthCamera& depth, const std::vector<TexturedPlane>& planes) {
  return render(depth.camera, depth.T_cam_depth, planes).depth;
}

TEST(DepthLookup, CarriesDepthOverFromACameraBeside) {
  const DepthCamera depth = beside();
  const TexturedPlane wall{pose({0.2, 0.3, 0}, {0, 0, 2}), 1e3, 1e3, {}};
  const Image truth = render(kCamera, SE3(), {wall}).depth;
  std::vector<Eigen::Vector2f> px;
  for (int v = 30; v < 90; v += 7)
    for (int u = 40; u < 120; u += 9) px.emplace_back(u, v);
  const auto found = lookup_depth(depth_image(depth, {wall}), kCamera, depth, px);
  for (std::size_t i = 0; i < px.size(); ++i) {
    ASSERT_TRUE(found[i]) << px[i].transpose();
    const double z = truth.at<float>(static_cast<int>(px[i].y()), static_cast<int>(px[i].x()));
    // Each depth pixel falls up to half a pixel aside, on a slope of tan(0.36) z / f a pixel.
    EXPECT_NEAR(*found[i], z, 0.38 * z / kCamera.fx);
  }
}

TEST(DepthLookup, FindsTheSlopeOfASurface) {
  const Camera camera = pinhole(640, 480, 525);  // few pixels of a small image are near
  const DepthCamera depth{camera, SE3(), 0.005};
  const TexturedPlane wall{pose({0.2, 0.3, 0}, {0, 0, 2}), 1e3, 1e3, {}};
  const Image image = depth_image(depth, {wall});
  const auto found = lookup_surfaces(image, camera, depth, {{60, 70}})[0];
  ASSERT_TRUE(found);
  const double z = image.at<float>(70, 60);
  EXPECT_NEAR(found->depth_m, z, 0.01 * z);
  EXPECT_NEAR(found->gradient.x(), 1 / image.at<float>(70, 61) - 1 / z, 1e-5);
  EXPECT_NEAR(found->gradient.y(), 1 / image.at<float>(71, 60) - 1 / z, 1e-5);
  EXPECT_GT(found->gradient.norm(), 1e-4);
}

TEST(DepthLookup, SaysNothingWhereNearAndFarMeet) {
  const DepthCamera depth = beside();
  const TexturedPlane wall{pose({0, 0, 0}, {0, 0, 3}), 1e3, 1e3, {}};
  TexturedPlane board{pose({0, 0, 0}, {0, 0, 1}), 0.2, 10, {}};
  const Image image = depth_image(depth, {wall, board});
  const double edge = kCamera.cx + kCamera.fx * 0.2;
  const auto at = [&](double offset_px) {
    return lookup_depth(image, kCamera, depth, {{static_cast<float>(edge + offset_px), 60.0f}})[0];
  };
  EXPECT_FALSE(at(-0.5));
  ASSERT_TRUE(at(-6));
  EXPECT_NEAR(*at(-6), 1, 0.01);
  // Right of the board the wall begins only where the depth camera sees past it.
  ASSERT_TRUE(at(12));
  EXPECT_NEAR(*at(12), 3, 0.03);
}

TEST(DepthLookup, FindsTheSameInImagesOfEverySize) {
  // A floor seen at a slant: its depth changes by so much an angle, not by so much a pixel.
  for (const double size : {0.25, 0.5, 1.0, 2.0}) {
    const Camera camera =
        pinhole(static_cast<int>(640 * size), static_cast<int>(480 * size), 525 * size);
    const DepthCamera depth{camera, SE3(), 0.005};
    Image image(camera.height, camera.width, CV_32FC1, cv::Scalar(0));
    for (int v = 0; v < image.rows; ++v)
      if (const double down = (v - camera.cy) / camera.fy; down > 0.05)
        image.row(v).setTo(1.4 / down);
    std::vector<Eigen::Vector2f> px;
    for (const double down : {0.1, 0.25, 0.35, 0.4})
      px.emplace_back(static_cast<float>(camera.cx),
                      static_cast<float>(camera.cy + camera.fy * down));
    const auto found = lookup_depth(image, camera, depth, px);
    EXPECT_FALSE(found[0]) << size;
    EXPECT_FALSE(found[1]) << size;
    ASSERT_TRUE(found[3]) << size;
    EXPECT_NEAR(*found[3], 3.5, 0.05) << size;
  }
}

TEST(DepthLookup, SaysNothingWhereNothingWasMeasured) {
  DepthCamera depth{kCamera, SE3(), 0.005};
  Image image(120, 160, CV_32FC1, cv::Scalar(2.0f));
  image.colRange(0, 80).setTo(0);
  const auto found =
      lookup_depth(image, kCamera, depth, {{40, 60}, {120, 60}, {-20, 10}, {500, 500}});
  EXPECT_FALSE(found[0]);
  ASSERT_TRUE(found[1]);
  EXPECT_FLOAT_EQ(static_cast<float>(*found[1]), 2.0f);
  EXPECT_FALSE(found[2]);
  EXPECT_FALSE(found[3]);
  image.setTo(std::numeric_limits<float>::quiet_NaN());
  EXPECT_FALSE(lookup_depth(image, kCamera, depth, {{40, 60}})[0]);
}

TEST(DepthLookup, RefusesDepthThatIsNotInMetres) {
  EXPECT_THROW(lookup_depth(Image(120, 160, CV_16UC1), kCamera, {kCamera, SE3(), 0.005}, {}),
               ArgumentError);
}

}  // namespace depth_lookup_test
}  // namespace placegraph
