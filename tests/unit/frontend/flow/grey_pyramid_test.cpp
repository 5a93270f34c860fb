#include <gtest/gtest.h>
#include <placegraph/frontend/flow/grey_pyramid.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace placegraph {
namespace grey_pyramid_test {

TEST(GreyPyramidLevels, HavePixelsAtMultiplesOfTwo) {
  // A plane of grey values has the same value at the same place of every level.
  Image image(72, 96, CV_8UC1);
  for (int v = 0; v < 72; ++v)
    for (int u = 0; u < 96; ++u)
      image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(u + 2 * v);
  const std::vector<Image> pyramid = grey_pyramid(image, 3);
  ASSERT_EQ(pyramid.size(), 3u);
  for (int level = 0; level < 3; ++level) {
    const Image& at = pyramid[static_cast<std::size_t>(level)];
    EXPECT_EQ(at.type(), CV_32FC1);
    EXPECT_EQ(at.size(), cv::Size(96 >> level, 72 >> level));
    const int border = 4;  // the blur reaches two pixels over it, and two of the level above
    for (int v = border; v < at.rows - border; ++v)
      for (int u = border; u < at.cols - border; ++u)
        EXPECT_NEAR(at.at<float>(v, u), (u + 2 * v) << level, 1e-3) << level;
  }
}

TEST(GreyPyramidLevels, EndBeforeASideOfEightPixelsIsHalved) {
  const auto levels = [](int width, int height) {
    return grey_pyramid(Image(height, width, CV_8UC1, cv::Scalar(90)), 9).size();
  };
  EXPECT_EQ(levels(15, 100), 1u);
  EXPECT_EQ(levels(16, 100), 2u);
  EXPECT_EQ(levels(200, 64), 4u);
  EXPECT_EQ(grey_pyramid(Image(64, 64, CV_8UC1, cv::Scalar(90)), 1).size(), 1u);
  EXPECT_THROW((void)grey_pyramid(Image(9, 9, CV_32FC1), 2), ArgumentError);
  EXPECT_THROW((void)grey_pyramid(Image(), 2), ArgumentError);
}

TEST(Bicubic, HasTheDerivativesOfItsValuesAndPassesThroughThePixels) {
  Random random(1);
  Image image(9, 11, CV_32FC1);
  for (int v = 0; v < 9; ++v)
    for (int u = 0; u < 11; ++u) image.at<float>(v, u) = static_cast<float>(random.uniform(0, 255));
  constexpr double kStep = 1e-4;
  for (int round = 0; round < 100; ++round) {
    const double u = random.uniform(1.01, 8.99), v = random.uniform(1.01, 6.99);
    const GreySample sample = sample_bicubic(image, u, v);
    EXPECT_DOUBLE_EQ(sample.value, value_bicubic(image, u, v));
    // Second derivatives of some thousand grey levels change over the step.
    EXPECT_NEAR(
        sample.du,
        (value_bicubic(image, u + kStep, v) - value_bicubic(image, u - kStep, v)) / (2 * kStep),
        0.1);
    EXPECT_NEAR(
        sample.dv,
        (value_bicubic(image, u, v + kStep) - value_bicubic(image, u, v - kStep)) / (2 * kStep),
        0.1);
    const int at_u = static_cast<int>(u), at_v = static_cast<int>(v);
    EXPECT_NEAR(value_bicubic(image, at_u, at_v), image.at<float>(at_v, at_u), 1e-4);
    // From one pixel to the next neither value nor slope jumps.
    const GreySample left = sample_bicubic(image, at_u + 1 - 1e-9, v),
                     right = sample_bicubic(image, at_u + 1, v);
    EXPECT_NEAR(left.value, right.value, 1e-4);
    EXPECT_NEAR(left.du, right.du, 1e-3);
  }
}

}  // namespace grey_pyramid_test
}  // namespace placegraph
