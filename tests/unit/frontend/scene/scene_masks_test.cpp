#include <gtest/gtest.h>
#include <placegraph/frontend/scene/scene_masks.h>
#include <placegraph/graph/core/error.h>

#include <opencv2/core.hpp>

namespace placegraph {
namespace scene_masks_test {

/// Four superpixels of 40 x 10, one above the other: sky, vertical, object, ground.
SceneView layered() {
  SceneView view;
  view.rows = view.cols = 40;
  view.superpixels.count = 4;
  view.superpixels.rows = view.superpixels.cols = 40;
  view.superpixels.index = Image(40, 40, CV_32SC1);
  for (int v = 0; v < 40; ++v) view.superpixels.index.row(v).setTo(v / 10);
  return view;
}

std::vector<float> sure(float p) {
  const float rest = (1 - p) / 3;
  std::vector<float> surfaces;
  for (const std::size_t of : {0u, 2u, 3u, 1u})
    for (std::size_t c = 0; c < kSurfaceCount; ++c) surfaces.push_back(c == of ? p : rest);
  return surfaces;
}

bool at(const Image& mask, int v) { return mask.at<std::uint8_t>(v, 20) != 0; }

TEST(SceneMasks, LeaveOutSkyAndWhatMayMoveWithItsMargin) {
  SceneMaskOptions options;
  options.margin_px = 3;
  const SceneMasks masks = mask_scene(sure(0.95f), layered(), options);
  EXPECT_FALSE(at(masks.use, 5));
  EXPECT_TRUE(at(masks.still, 5));  // sky stands still
  EXPECT_TRUE(at(masks.use, 14));
  EXPECT_TRUE(at(masks.use, 16));
  EXPECT_FALSE(at(masks.use, 17));
  EXPECT_FALSE(at(masks.still, 25));
  EXPECT_FALSE(at(masks.use, 32));
  EXPECT_TRUE(at(masks.use, 33));
  EXPECT_FALSE(at(masks.ground, 15));
  EXPECT_TRUE(at(masks.ground, 35));
}

TEST(SceneMasks, AcceptOnlyCertainPixelsAndLeaveEnough) {
  const SceneMasks unsure = mask_scene(sure(0.55f), layered(), {});
  EXPECT_TRUE(at(unsure.use, 5));
  EXPECT_TRUE(at(unsure.use, 25));
  SceneMaskOptions options;
  options.min_share = 0.6;  // half of the picture is sky or may move
  EXPECT_TRUE(mask_scene(sure(0.95f), layered(), options).use.empty());
}

TEST(SceneMasks, AreOfThePicturesSizeAndRefuseOtherNumbers) {
  SceneView view = layered();
  view.rows = 80, view.cols = 60;
  const SceneMasks masks = mask_scene(sure(0.95f), view, {});
  EXPECT_EQ(masks.use.size(), cv::Size(60, 80));
  EXPECT_EQ(masks.ground.size(), cv::Size(60, 80));
  EXPECT_THROW((void)mask_scene({1, 0, 0, 0}, view, {}), ArgumentError);
}

TEST(SurfaceShares, AreThoseOfTheUpperAndTheLowerHalf) {
  const SurfaceShares shares = surface_shares(sure(1), layered());
  EXPECT_NEAR(shares.above[0], 0.5, 1e-6);
  EXPECT_NEAR(shares.above[2], 0.5, 1e-6);
  EXPECT_NEAR(shares.below[1], 0.5, 1e-6);
  EXPECT_NEAR(shares.below[3], 0.5, 1e-6);
}

}  // namespace scene_masks_test
}  // namespace placegraph
