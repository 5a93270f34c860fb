#include <gtest/gtest.h>
#include <placegraph/frontend/segments/segment_flow.h>
#include <placegraph/frontend/segments/segment_profile.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

#include "tests/support/noise_image.h"

namespace placegraph {
namespace segment_profile_test {

using Eigen::Vector2d;

TEST(LineProfileImage, HasAPlaneOfGreysAtTheSamePlacesOnEveryLevel) {
  Image image(96, 96, CV_8UC1);
  for (int v = 0; v < 96; ++v)
    for (int u = 0; u < 96; ++u) image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(u + v);
  const LineProfileImage levels(image);
  for (int level = 0; level < 4; ++level)
    for (const Vector2d& px : {Vector2d(47, 50), Vector2d(40.3, 55.9), Vector2d(52.75, 44)})
      EXPECT_NEAR(levels.grey(px, level), px.x() + px.y(), 0.02) << level;
  // Outside it is as at the border.
  EXPECT_NEAR(levels.grey({-30, 48}, 0), levels.grey({0, 48}, 0), 1e-4);
  EXPECT_TRUE(levels.contains({0, 95}));
  EXPECT_FALSE(levels.contains({-0.1, 20}));
  EXPECT_FALSE(levels.contains({20, 95.1}));
}

TEST(LineProfileImage, TakesTheLevelOfTheStep) {
  const LineProfileImage levels(test::noise_image(96, 96, CV_8UC1, 1, 1));
  for (const auto& [step_px, level] :
       {std::pair{0.3, 0}, {1.0, 0}, {1.6, 0}, {1.8, 1}, {3.3, 1}, {3.5, 2}, {8.0, 3}, {99.0, 3}})
    EXPECT_EQ(levels.level_of(step_px), level) << step_px;
  EXPECT_EQ(LineProfileImage(test::noise_image(20, 20, CV_8UC1, 1, 1)).level_of(8), 1);
  EXPECT_THROW(LineProfileImage(Image(8, 90, CV_8UC1)), ArgumentError);
  EXPECT_THROW(LineProfileImage(Image(90, 90, CV_32FC1)), ArgumentError);
}

TEST(CompareStrips, FollowsTheStripsAndNotTheImages) {
  const Image image = test::noise_image(100, 100, CV_8UC1, 3, 2);
  Image turned;
  cv::rotate(image, turned, cv::ROTATE_90_CLOCKWISE);
  const LineProfileImage a(image), b(turned);
  const auto turn = [](const Vector2d& px) { return Vector2d(99 - px.y(), px.x()); };
  const Vector2d from(30, 40), to(70, 55), across = Vector2d(-15, 40).normalized();
  const LineProfile here{from, to, across}, there{turn(from), turn(to), {-across.y(), across.x()}};
  const LineProfileSimilarity same = compare_strips(a, here, b, there, 8);
  EXPECT_NEAR(same.both, 1, 1e-6);
  EXPECT_NEAR(same.left, 1, 1e-6);
  EXPECT_NEAR(same.right, 1, 1e-6);
  // With the sides exchanged in both strips left is right; in one alone nothing is alike.
  const LineProfileSimilarity one = compare_strips(a, here, a, {{31, 40}, {71, 55}, across}, 8),
                              other = compare_strips(a, {from, to, -across}, a,
                                                     {{31, 40}, {71, 55}, -across}, 8);
  EXPECT_NEAR(one.left, other.right, 1e-9);
  EXPECT_NEAR(one.right, other.left, 1e-9);
  EXPECT_NEAR(one.both, other.both, 1e-9);
  EXPECT_LT(compare_strips(a, here, a, {from, to, -across}, 8).both, 0.6);
}

/// An edge between two levels of grey, smoothed over a pixel and a half.
Image edge_image(const Vector2d& on, double angle, double gain) {
  Image image(100, 120, CV_8UC1);
  const Vector2d n(std::cos(angle), std::sin(angle));
  for (int v = 0; v < 100; ++v)
    for (int u = 0; u < 120; ++u)
      image.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(
          gain * (100 + 40 * std::tanh(n.dot(Vector2d(u, v) - on) / 1.5)));
  return image;
}

TEST(FollowSegment, FindsShiftAndRotationOfAnEdgeInOtherLight) {
  const Vector2d middle(60, 50);
  const double angle = 1.4;
  const auto segment_of = [&](double turn, double shift) {
    const Vector2d n(std::cos(angle + turn), std::sin(angle + turn)), along(n.y(), -n.x());
    return LineSegment{middle + shift * n - 25 * along, middle + shift * n + 25 * along};
  };
  const LineProfileImage from(edge_image(middle, angle, 1));
  const LineSegment segment = segment_of(0, 0);
  for (const double shift : {-3.0, 0.0, 0.6, 4.0})
    for (const double turn : {-0.06, 0.0, 0.04}) {
      const Vector2d n(std::cos(angle + turn), std::sin(angle + turn));
      const LineProfileImage to(edge_image(middle + shift * n, angle + turn, 1.3));
      const auto flow = follow_segment(from, segment, to, segment, 2);
      ASSERT_TRUE(flow) << shift << ' ' << turn;
      // Grey values are rounded: thousandths of a pixel for a hundred samples. The ends of the
      // step are at 0.02 px.
      for (const Vector2d& end : {flow->segment.start, flow->segment.end})
        EXPECT_NEAR(n.dot(end - middle), shift, 0.06) << shift << ' ' << turn;
      EXPECT_GT(flow->similar.both, 0.99);
    }
}

TEST(FollowSegment, IsNothingWithoutAnImageOrLength) {
  const Vector2d middle(60, 50);
  const LineProfileImage image(edge_image(middle, 1.4, 1));
  const LineSegment inside{{40, 50}, {80, 50}}, outside{{300, 50}, {340, 50}};
  EXPECT_FALSE(follow_segment(image, inside, image, outside, 1));
  EXPECT_FALSE(follow_segment(image, {{40, 50}, {43, 50}}, image, inside, 1));
  EXPECT_FALSE(follow_segment(image, inside, image, {{40, 50}, {43, 50}}, 1));
}

}  // namespace segment_profile_test
}  // namespace placegraph
