#include <numbers>

#include <gtest/gtest.h>
#include <placegraph/frontend/lines/line_feature.h>
#include <placegraph/graph/core/error.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace line_feature_test {

using namespace test;

const Camera kCamera = pinhole(640, 480, 500);

/// A wall of rectangles in greys of their own, moved by whole pixels.
Image wall(const Eigen::Vector2i& shift_px) {
  Random random = seeded_random(311);
  Image image(480, 640, CV_8UC1, cv::Scalar(90));
  for (int k = 0; k < 60; ++k) {
    const cv::Point corner(static_cast<int>(random.uniform(0, 600)) + shift_px.x(),
                           static_cast<int>(random.uniform(0, 440)) + shift_px.y());
    const cv::Size size(static_cast<int>(random.uniform(30, 150)),
                        static_cast<int>(random.uniform(30, 150)));
    cv::rectangle(image, cv::Rect(corner, size), cv::Scalar(random.uniform(0, 255)), cv::FILLED);
  }
  cv::GaussianBlur(image, image, {}, 1.0);
  return image;
}

TEST(LineFeature, DescriptorsFollowTheirEdgeAndTellEdgesApart) {
  const Eigen::Vector2i shift(7, -4);
  Random random = seeded_random(312);
  std::vector<LineSegment> here, there;
  for (int k = 0; k < 25; ++k) {
    const Eigen::Vector2d start(random.uniform(60, 500), random.uniform(60, 400));
    const double angle = random.uniform(-std::numbers::pi, std::numbers::pi);
    const LineSegment segment{start,
                              start + 50 * Eigen::Vector2d(std::cos(angle), std::sin(angle))};
    here.push_back(segment);
    there.push_back({segment.start + shift.cast<double>(), segment.end + shift.cast<double>()});
  }
  const auto before = describe_segments(wall({0, 0}), here),
             after = describe_segments(wall(shift), there);
  int nearest_is_right = 0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    std::size_t nearest = 0;
    for (std::size_t j = 1; j < there.size(); ++j)
      if (hamming_distance(before[i], after[j]) < hamming_distance(before[i], after[nearest]))
        nearest = j;
    nearest_is_right += nearest == i;
  }
  EXPECT_GE(nearest_is_right, 23);
}

TEST(LineFeature, RefusesSegmentsOutsideTheImageAndOtherImages) {
  const Image image = wall({0, 0});
  EXPECT_THROW((void)describe_segments(image, {{{10, 10}, {700, 10}}}), ArgumentError);
  EXPECT_THROW((void)describe_segments(image, {{{10, 10}, {10, 10}}}), ArgumentError);
  EXPECT_THROW((void)describe_segments(Image(9, 9, CV_32FC1), {{{1, 1}, {5, 5}}}), ArgumentError);
  EXPECT_TRUE(describe_segments(image, {}).empty());
}

/// Lines before two cameras, with descriptors of their own; those of `a` in the order of `b`.
struct TwoViews {
  std::vector<LineFeature> a, b;
};
const SE3 kTruth = pose({0.02, -0.05, 0.03}, {0.3, 0.1, 0.2});  // T_b_a

TwoViews two_views(int count, Random& random) {
  TwoViews views;
  while (static_cast<int>(views.b.size()) < count) {
    const Eigen::Vector3d start(random.uniform(-3, 3), random.uniform(-2, 2), random.uniform(4, 9));
    const Eigen::Vector3d end =
        start +
        Eigen::Vector3d(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-1, 1));
    const auto seen = [&](const SE3& T_cam_b) -> std::optional<LineSegment> {
      const auto p = kCamera.project(T_cam_b * start), q = kCamera.project(T_cam_b * end);
      if (!p || !q || !kCamera.contains(*p) || !kCamera.contains(*q)) return std::nullopt;
      return LineSegment{*p, *q};
    };
    const auto in_a = seen(kTruth.inverse()), in_b = seen(SE3());
    if (!in_a || !in_b || in_a->length() < 20 || in_b->length() < 20) continue;
    const BinaryDescriptor descriptor = random_descriptor(random);
    views.b.push_back({*in_b, descriptor, Line3::from_direction(start, end - start)});
    views.a.push_back({*in_a, flipped(descriptor, 20, random), std::nullopt});
  }
  return views;
}

TEST(LineFeature, MatchesLinesWhereThePoseExpectsThem) {
  Random random = seeded_random(313);
  TwoViews views = two_views(40, random);
  const auto matches = match_lines_guided(kCamera, views.a, views.b, kTruth);
  EXPECT_EQ(matches.size(), 40u);
  for (const LineFeatureMatch& match : matches) EXPECT_EQ(match.a, match.b);
  // An edge of other polarity, another descriptor, or another place is another edge.
  std::swap(views.a[0].segment.start, views.a[0].segment.end);
  views.a[1].descriptor = random_descriptor(random);
  const Eigen::Vector2d aside = 30 * views.a[2].segment.normal();
  views.a[2].segment.start += aside, views.a[2].segment.end += aside;
  views.b[3].line_cam.reset();
  EXPECT_EQ(match_lines_guided(kCamera, views.a, views.b, kTruth).size(), 36u);
  const SE3 elsewhere = kTruth * pose({0, 0.3, 0}, {0, 0, 0});
  EXPECT_LT(match_lines_guided(kCamera, views.a, views.b, elsewhere).size(), 5u);
}

}  // namespace line_feature_test
}  // namespace placegraph
