#include <gtest/gtest.h>
#include <placegraph/frontend/labels/box_sums.h>
#include <placegraph/frontend/labels/scene_channels.h>
#include <placegraph/frontend/labels/training/scene_variants.h>
#include <placegraph/frontend/labels/superpixels.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <opencv2/core.hpp>

#include "tests/support/scenes/scene_images.h"

namespace placegraph {
namespace scene_features_test {

TEST(BoxSums, GivesTheRoundedMeanOfTheBoxWithinTheImage) {
  // 2 x 3 pixels of two channels: 0, 10, 20 / 30, 40, 50 and all 7.
  const BoxSums sums({0, 7, 10, 7, 20, 7, 30, 7, 40, 7, 50, 7}, 2, 3, 2);
  std::array<std::uint8_t, 2> means;
  sums.means({0, 0, 3, 2}, means.data());
  EXPECT_EQ(means, (std::array<std::uint8_t, 2>{25, 7}));
  sums.means({1, 0, 9, 1}, means.data());  // reaches out on the right
  EXPECT_EQ(means[0], 15);
  sums.means({-9, 5, -5, 9}, means.data());  // lies outside: the nearest pixel
  EXPECT_EQ(means[0], 30);
  EXPECT_THROW(BoxSums({1, 2, 3}, 1, 1, 2), ArgumentError);
}

TEST(SceneChannels, EdgesAndRelativeColourStayWhenTheLightIsHalved) {
  const test::DrawnStreet street = test::draw_street(1);
  const Image bright = street.bgr, dim = street.bgr * 0.5;
  const SceneChannels a = scene_channels(bright), b = scene_channels(dim);
  for (const int c : {int{SceneChannels::kRedRelative}, int{SceneChannels::kBlueRelative},
                      int{SceneChannels::kShare}, int{SceneChannels::kRank}}) {
    double difference = 0;
    for (int v = 0; v < a.rows; ++v)
      for (int u = 0; u < a.cols; ++u) difference += std::abs(a.at(v, u)[c] - b.at(v, u)[c]);
    EXPECT_LT(difference / (a.rows * a.cols), 12) << "channel " << c;  // of 255
  }
}

TEST(SceneChannels, AnUprightEdgeIsSeenInItsDirectionAlone) {
  Image bgr(80, 80, CV_8UC3, cv::Scalar::all(40));
  bgr.colRange(40, 80).setTo(cv::Scalar::all(200));
  const SceneChannels channels = scene_channels(bgr);
  const std::uint8_t* at = channels.at(20, 20);
  EXPECT_GT(at[SceneChannels::kShare], 200);  // the gradient points along 0 degrees
  for (int i = 1; i < 6; ++i) EXPECT_LT(at[SceneChannels::kShare + i], 20) << i;
  EXPECT_GT(at[SceneChannels::kCoarseUpright], at[SceneChannels::kCoarseLevel]);
  EXPECT_EQ(channels.at(5, 5)[SceneChannels::kEdge], 0);
  EXPECT_THROW((void)scene_channels(Image(80, 81, CV_8UC3)), ArgumentError);
}

TEST(Superpixels, HoldTheBordersOfWhatIsDrawnAndKnowWhoLiesAbove) {
  const test::DrawnStreet street = test::draw_street(2);
  const Superpixels cut = cut_superpixels(street.bgr);
  std::vector<std::array<int, 4>> pixels(static_cast<std::size_t>(cut.count));
  for (int v = 0; v < cut.rows; ++v)
    for (int u = 0; u < cut.cols; ++u)
      ++pixels[static_cast<std::size_t>(cut.index.at<int>(v, u))]
              [street.labels.at<std::uint8_t>(v, u)];
  int best = 0, area = 0;
  for (const auto& counts : pixels) best += *std::max_element(counts.begin(), counts.end());
  for (const RegionShape& shape : cut.shapes) area += shape.area_px;
  EXPECT_GT(best, 0.95 * cut.rows * cut.cols);
  EXPECT_EQ(area, cut.rows * cut.cols);

  Image index(4, 4, CV_32SC1, cv::Scalar(0));
  index.rowRange(2, 4).setTo(1);
  const Superpixels two = superpixels_of_index(index, 2);
  ASSERT_EQ(two.borders.size(), 1u);
  EXPECT_EQ(two.borders[0].above, 4);
  EXPECT_EQ(two.borders[0].length(), 4);
  EXPECT_FLOAT_EQ(two.shapes[1].v, 2.5f);
  EXPECT_THROW((void)cut_superpixels(Image(10, 10, CV_8UC3)), ArgumentError);
}

TEST(SceneVariants, MoveLabelsWithThePictureAndRepeatWithTheirSeed) {
  const test::DrawnStreet street = test::draw_street(4);
  Random first(5), second(5);
  const SceneVariant a = vary_scene(street.bgr, street.labels, 255, true, first);
  const SceneVariant b = vary_scene(street.bgr, street.labels, 255, true, second);
  EXPECT_EQ(cv::norm(a.bgr, b.bgr, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(a.labels, b.labels, cv::NORM_INF), 0);
}

TEST(SceneVariants, KeepTheirColourInAnyLightOrHaveNone) {
  const test::DrawnStreet street = test::draw_street(4);
  constexpr int kVariants = 60;
  int grey = 0;
  for (std::uint64_t seed = 1; seed <= kVariants; ++seed) {
    Random random(seed);
    const SceneVariant variant = vary_scene(street.bgr, street.labels, 255, true, random);
    std::vector<Image> channels;
    cv::split(variant.bgr, channels);
    if (cv::norm(channels[0], channels[2], cv::NORM_INF) == 0) {
      ++grey;
      continue;
    }
    // The box stays redder than the road.
    const cv::Scalar box = cv::mean(variant.bgr, variant.labels == 3),
                     road = cv::mean(variant.bgr, variant.labels == 1);
    EXPECT_GT(box[2] / (box[1] + 1), 1.5 * road[2] / (road[1] + 1)) << seed;
  }
  EXPECT_GT(grey, 10);  // 20 expected, deviation 3.7
  EXPECT_LT(grey, 31);
}

}  // namespace scene_features_test
}  // namespace placegraph
