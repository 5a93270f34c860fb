#include <gtest/gtest.h>
#include <placegraph/frontend/flow/corners.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "tests/support/scenes/texture.h"

namespace placegraph {
namespace corners_test {

using test::texture_image;
const Image kTextured = texture_image(131, 97, {7, 24, 2, 50});

TEST(Corners, AreWhereOpenCvHasThemWithItsStrengths) {
  constexpr int kBorder = 6;
  constexpr double kLeast = 1e-4;
  Image strength, largest;
  cv::cornerMinEigenVal(kTextured, strength, 5, 3);
  cv::dilate(strength, largest, Image());
  std::size_t expected = 0;
  for (int v = kBorder; v < kTextured.rows - kBorder; ++v)
    for (int u = kBorder; u < kTextured.cols - kBorder; ++u)
      expected +=
          strength.at<float>(v, u) > kLeast && strength.at<float>(v, u) == largest.at<float>(v, u);
  const auto corners = find_corners(kTextured, kLeast, kBorder);
  ASSERT_GT(expected, 50u);
  EXPECT_EQ(corners.size(), expected);
  for (const Corner& c : corners) {
    const float theirs = strength.at<float>(c.v, c.u);
    EXPECT_NEAR(c.strength, theirs, 1e-4 * theirs) << c.u << " " << c.v;
    // Equal up to rounding: no neighbour is clearly stronger.
    EXPECT_GE(theirs, largest.at<float>(c.v, c.u) * (1 - 1e-4f));
  }
}

TEST(Corners, OfASquareAreItsFour) {
  Image image(60, 80, CV_8UC1, cv::Scalar(20));
  image(cv::Rect(25, 20, 20, 16)).setTo(220);
  const auto corners = find_corners(image, 1e-3, 8);
  // Of plateaus of equal strength all pixels count: some may stand for one corner.
  ASSERT_GE(corners.size(), 4u);
  for (const Corner& c : corners) {
    const double du = std::min(std::abs(c.u - 24.5), std::abs(c.u - 44.5));
    const double dv = std::min(std::abs(c.v - 19.5), std::abs(c.v - 35.5));
    EXPECT_LT(std::max(du, dv), 3) << c.u << " " << c.v;
  }
  EXPECT_TRUE(std::is_sorted(corners.begin(), corners.end(),
                             [](const Corner& a, const Corner& b) { return a.v < b.v; }));
}

TEST(Corners, AreNotWhereTheyAreBlockedOrMasked) {
  Image blocked = Image::zeros(kTextured.size(), CV_8UC1);
  blocked.colRange(0, 60).setTo(1);
  Image mask(kTextured.size(), CV_8UC1, cv::Scalar(255));
  mask.rowRange(0, 40).setTo(0);
  const auto all = find_corners(kTextured, 1e-4, 8);
  const auto some = find_corners(kTextured, 1e-4, 8, blocked, mask);
  ASSERT_FALSE(some.empty());
  const auto expected =
      std::count_if(all.begin(), all.end(), [](const Corner& c) { return c.u >= 60 && c.v >= 40; });
  EXPECT_EQ(static_cast<std::ptrdiff_t>(some.size()), expected);
  for (const Corner& c : some) EXPECT_TRUE(c.u >= 60 && c.v >= 40);
}

TEST(Corners, RefuseOtherSizesTypesAndNarrowBorders) {
  EXPECT_THROW((void)find_corners(Image(20, 20, CV_8UC3), 1e-4, 8), ArgumentError);
  EXPECT_THROW((void)find_corners(kTextured, 1e-4, 3), ArgumentError);
  EXPECT_THROW((void)find_corners(kTextured, 1e-4, 8, Image::zeros(5, 5, CV_8UC1)), ArgumentError);
  EXPECT_TRUE(find_corners(Image::zeros(12, 12, CV_8UC1), 1e-4, 8).empty());
}

}  // namespace corners_test
}  // namespace placegraph
