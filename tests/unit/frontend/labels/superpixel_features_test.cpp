#include <gtest/gtest.h>
#include <placegraph/frontend/labels/superpixel_features.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <utility>

namespace placegraph {
namespace superpixel_features_test {

/// An image of blocks of 4 x 4 pixels with random numbers, all of them at least once.
Image draw_index(int rows, int cols, int count, Random& random) {
  Image index(rows, cols, CV_32SC1);
  int next = 0;
  for (int v = 0; v < rows; v += 4)
    for (int u = 0; u < cols; u += 4)
      index(cv::Rect(u, v, std::min(4, cols - u), std::min(4, rows - v)))
          .setTo(next < count ? next++ : random.index(count));
  return index;
}

TEST(SuperpixelsOfIndex, HaveTheShapesOfTheirPixels) {
  Random random(1);
  for (const auto& [rows, cols, count] : {std::array{4, 4, 1}, {13, 22, 9}, {24, 16, 20}}) {
    const Image index = draw_index(rows, cols, count, random);
    const Superpixels superpixels = superpixels_of_index(index, count);
    for (int i = 0; i < count; ++i) {
      std::vector<std::pair<int, int>> pixels;
      double u_mean = 0, v_mean = 0;
      for (int v = 0; v < rows; ++v)
        for (int u = 0; u < cols; ++u)
          if (index.at<int>(v, u) == i) pixels.emplace_back(u, v), u_mean += u, v_mean += v;
      const auto n = static_cast<double>(pixels.size());
      u_mean /= n, v_mean /= n;
      double uu = 0, uv = 0, vv = 0;
      int min_u = cols, max_v = -1;
      for (const auto& [u, v] : pixels) {
        uu += (u - u_mean) * (u - u_mean) / n, uv += (u - u_mean) * (v - v_mean) / n;
        vv += (v - v_mean) * (v - v_mean) / n;
        min_u = std::min(min_u, u), max_v = std::max(max_v, v);
      }
      const RegionShape& shape = superpixels.shapes[static_cast<std::size_t>(i)];
      EXPECT_EQ(shape.area_px, static_cast<int>(n));
      EXPECT_NEAR(shape.u, u_mean, 1e-4);
      EXPECT_NEAR(shape.v, v_mean, 1e-4);
      EXPECT_NEAR(shape.uu, uu, 1e-3);
      EXPECT_NEAR(shape.uv, uv, 1e-3);
      EXPECT_NEAR(shape.vv, vv, 1e-3);
      EXPECT_EQ(shape.min_u, min_u);
      EXPECT_EQ(shape.max_v, max_v);
    }
  }
}

TEST(SuperpixelsOfIndex, HaveTheBordersOfTheirPixels) {
  Random random(2);
  const Image index = draw_index(18, 23, 8, random);
  struct Counts {
    int beside = 0, above = 0, below = 0;
  };
  std::map<std::pair<int, int>, Counts> expected;
  for (int v = 0; v < 18; ++v)
    for (int u = 0; u < 23; ++u) {
      const int here = index.at<int>(v, u);
      if (u > 0 && index.at<int>(v, u - 1) != here)
        ++expected[std::minmax(here, index.at<int>(v, u - 1))].beside;
      if (v == 0 || index.at<int>(v - 1, u) == here) continue;
      Counts& counts = expected[std::minmax(here, index.at<int>(v - 1, u))];
      ++(index.at<int>(v - 1, u) < here ? counts.above : counts.below);
    }
  const Superpixels superpixels = superpixels_of_index(index, 8);
  ASSERT_EQ(superpixels.borders.size(), expected.size());
  auto border = superpixels.borders.begin();
  for (const auto& [pair, counts] : expected) {
    EXPECT_EQ(std::pair(border->a, border->b), pair);
    EXPECT_EQ(border->beside, counts.beside);
    EXPECT_EQ(border->above, counts.above);
    EXPECT_EQ(border->below, counts.below);
    ++border;
  }
}

TEST(SuperpixelsOfIndex, RefuseAnythingElse) {
  EXPECT_THROW((void)superpixels_of_index(Image(4, 4, CV_8UC1), 1), ArgumentError);
  EXPECT_THROW((void)superpixels_of_index(Image(), 1), ArgumentError);
  EXPECT_THROW((void)superpixels_of_index(Image(4, 4, CV_32SC1, cv::Scalar(0)), 0), ArgumentError);
}

/// Three columns; that in the middle is an upper and a lower half.
Superpixels crossing() {
  Image index(24, 24, CV_32SC1, cv::Scalar(0));
  index(cv::Rect(8, 0, 8, 12)).setTo(1);
  index(cv::Rect(8, 12, 8, 12)).setTo(2);
  index(cv::Rect(16, 0, 8, 24)).setTo(3);
  return superpixels_of_index(index, 4);
}

TEST(ContextFeatures, AreWeightedByTheLengthsOfTheBorders) {
  const ByteFeatures shares{4, 2, {200, 55, 100, 155, 10, 245, 0, 255}};
  const ByteFeatures context = context_features(shares, crossing());
  ASSERT_EQ(context.dimension, context_dimension(2));
  const auto group = [&](int i, int which) {
    return std::pair<int, int>(context.row(i)[2 * which], context.row(i)[2 * which + 1]);
  };
  // Itself, above, below, beside, all around.
  EXPECT_EQ(group(1, 0), std::pair(100, 155));
  EXPECT_EQ(group(1, 1), std::pair(0, 0));  // nothing is above it
  EXPECT_EQ(group(1, 2), std::pair(10, 245));
  EXPECT_EQ(group(2, 1), std::pair(100, 155));
  EXPECT_EQ(group(2, 2), std::pair(0, 0));
  EXPECT_EQ(group(1, 3), std::pair(100, 155));  // 12 pixels of 0, and 12 of 3
  EXPECT_EQ(group(0, 3), std::pair(55, 200));   // 12 pixels of 1, and 12 of 2
  // 12 pixels of 0 and of 3, and 8 of 2: 77.5 and 177.5, rounded up.
  EXPECT_EQ(group(1, 4), std::pair(78, 178));
  // The last rectangle is the whole image: two sixths of 0 and of 3, a sixth of 1 and of 2.
  EXPECT_EQ(group(3, 32), std::pair(510 / 6, 1020 / 6));
  EXPECT_THROW((void)context_features({3, 2, std::vector<std::uint8_t>(6)}, crossing()),
               ArgumentError);
}

TEST(SuperpixelFeatures, OfAColourArePlacedByTheirShape) {
  // In a plain image superpixels differ by nothing but position and shape, the last 14 features.
  const Image plain(24, 24, CV_8UC3, cv::Scalar(40, 120, 200));
  const ByteFeatures features = superpixel_features(plain, crossing());
  ASSERT_EQ(features.dimension, kSuperpixelFeatures);
  for (int d = 0; d < kSuperpixelFeatures - 14; ++d)
    for (int i = 1; i < 4; ++i) EXPECT_EQ(features.row(i)[d], features.row(0)[d]) << d;
  const std::uint8_t *upper = features.row(1) + kSuperpixelFeatures - 14,
                     *lower = features.row(2) + kSuperpixelFeatures - 14,
                     *left = features.row(0) + kSuperpixelFeatures - 14,
                     *right = features.row(3) + kSuperpixelFeatures - 14;
  EXPECT_EQ(upper[0], lower[0]);
  EXPECT_NEAR(lower[1] - upper[1], 12 / 24.0 * 255, 1);
  EXPECT_NEAR(right[0] - left[0], 16 / 24.0 * 255, 1);
  EXPECT_NEAR(left[9], 255, 1);  // it fills its bounding box
  EXPECT_EQ(left[8], 128 + static_cast<int>(60 * std::log(3.0) + 0.5));  // height over width
  EXPECT_THROW((void)superpixel_features(Image(24, 22, CV_8UC3), crossing()), ArgumentError);
}

}  // namespace superpixel_features_test
}  // namespace placegraph
