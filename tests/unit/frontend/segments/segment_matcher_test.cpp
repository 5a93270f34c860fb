#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/frontend/segments/local_motion.h>
#include <placegraph/frontend/segments/segment_matcher.h>
#include <placegraph/frontend/segments/segment_profile.h>
#include <placegraph/graph/core/error.h>

#include <opencv2/core.hpp>

#include "tests/support/scenes/texture.h"

namespace placegraph {
namespace segment_matcher_test {

using Eigen::Matrix2d;
using Eigen::Vector2d;

const Matrix2d kRotation = (Matrix2d() << 1.1, -0.3, 0.25, 0.9).finished();
const Vector2d kShift(40, -12);

PointPair moved(const Vector2d& px_a) {
  return {px_a, kRotation * px_a + kShift, Matrix2d::Identity()};
}

TEST(LocalMotion, PointsTellTheAffineMap) {
  std::vector<PointPair> points;
  for (int i = 0; i < 14; ++i) points.push_back(moved({30.0 * (i % 4), 40.0 * (i / 4)}));
  points[5].px_b += Vector2d(60, 30);  // one is wrong
  const auto motion = LocalMotionField(points).around({{20, 30}, {70, 60}});
  ASSERT_TRUE(motion);
  // The weak prior (identity) and the Cauchy tail of the outlier leave a little.
  EXPECT_LT((((*motion)({45, 45})) - (kRotation * Vector2d(45, 45) + kShift)).norm(), 0.5);
  EXPECT_LT((motion->A - kRotation).norm(), 0.03);
}

TEST(LocalMotion, LinesTellItWherePointsAreMissing) {
  std::vector<SegmentPair> segments;
  const auto add = [&](const Vector2d& p, const Vector2d& q) {
    const Vector2d from = kRotation * p + kShift, to = kRotation * q + kShift;
    // The ends in the other image are others: only the line counts.
    segments.push_back({{p, q}, {from + 0.3 * (to - from), to + 0.4 * (to - from)}});
  };
  for (double t : {0.0, 50.0, 100.0, 150.0}) add({t, -5}, {t + 7, 160}), add({-3, t}, {160, t + 5});
  const LocalMotionField field({moved({60, 60}), moved({80, 90})}, segments);
  const auto motion = field.around({{60, 70}, {110, 80}});
  ASSERT_TRUE(motion);
  EXPECT_LT((((*motion)({80, 75})) - (kRotation * Vector2d(80, 75) + kShift)).norm(), 0.3);
}

TEST(LocalMotion, TwoPiecesOfEvidenceAreTooFew) {
  const SegmentPair segment{{{0, 0}, {9, 0}}, {{0, 0}, {9, 0}}};
  const LocalMotionField field({moved({0, 0}), moved({10, 0})}, {segment});
  EXPECT_TRUE(field.around({{0, 5}, {20, 5}}));
  EXPECT_FALSE(field.around({{0, 5}, {20, 5}}, 0)) << "one of the three is not asked";
}

TEST(SegmentProfile, SameStripsAreSimilarWhateverGainAndBias) {
  const Image image = test::texture_image(80, 80, {.seed = 2, .wavelength = 16});
  Image other;
  image.convertTo(other, -1, 0.7, 20);
  const LineProfile frame{{20, 40}, {60, 45}, {-0.12, 0.99}};
  const auto same =
      compare_strips(LineProfileImage(image), frame, LineProfileImage(other), frame, 8);
  EXPECT_GT(same.both, 0.999);
  EXPECT_GT(same.left, 0.999);
  EXPECT_GT(same.right, 0.999);
  const LineProfile reversed{frame.to, frame.from, -frame.across};
  EXPECT_LT(
      compare_strips(LineProfileImage(image), frame, LineProfileImage(other), reversed, 8).both,
      0.7);
}

TEST(SegmentProfile, OneSideOutsideTheImageLeavesTheOther) {
  const LineProfileImage image(test::texture_image(80, 80, {.seed = 2, .wavelength = 16}));
  const LineProfile frame{{20, 1.5}, {60, 1.5}, {0, 1}};  // the left of the way is above the image
  const auto found = compare_strips(image, frame, image, frame, 8);
  EXPECT_EQ(found.both, -1);
  EXPECT_EQ(found.left, -1);
  EXPECT_GT(found.right, 0.999);
}

TEST(SegmentProfile, NothingIsLikeNothing) {
  const LineProfileImage flat(Image(60, 60, CV_8UC1, cv::Scalar(90)));
  const LineProfile frame{{20, 30}, {40, 30}, {0, 1}};
  EXPECT_EQ(compare_strips(flat, frame, flat, frame, 8).both, -1);
}

TEST(SegmentMatcher, BlankImagesHaveNoGeometry) {
  const Image blank(80, 80, CV_8UC1, cv::Scalar(90));
  const SegmentMatches found =
      match_segments(blank, {{{10, 10}, {60, 10}}}, blank, {{{10, 10}, {60, 10}}}, {});
  EXPECT_EQ(found.outcome.code, Outcome::Code::kNoConsensus);
  EXPECT_THAT(found.matches, testing::IsEmpty());
}

TEST(SegmentMatcher, RefusesWhatIsNoImageOrSegment) {
  const Image blank(80, 80, CV_8UC1, cv::Scalar(90));
  EXPECT_THROW((void)match_segments(Image(), {}, blank, {}, {}), Error);
  EXPECT_THROW((void)match_segments(blank, {{{1, 1}, {1, 1}}}, blank, {}, {}), Error);
}

}  // namespace segment_matcher_test
}  // namespace placegraph
