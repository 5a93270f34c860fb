#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/line_segment.h>

#include <cmath>
#include <numbers>

#include "tests/support/seed.h"

namespace placegraph {
namespace line_segment_test {

const LineSegment kAlongU{{10, 5}, {30, 5}};

TEST(LineSegment, KnowsItsSidesAndPositions) {
  EXPECT_DOUBLE_EQ(kAlongU.length(), 20);
  EXPECT_EQ(kAlongU.normal(), Eigen::Vector2d(0, 1));
  EXPECT_DOUBLE_EQ(kAlongU.offset_of({0, 8}), 3);
  EXPECT_DOUBLE_EQ(kAlongU.position_of({4, 8}), -6);
  EXPECT_DOUBLE_EQ(kAlongU.distance_to({15, 1}), 4);
  EXPECT_DOUBLE_EQ(kAlongU.distance_to({33, 9}), 5);
}

TEST(LineSegment, LineHasSegmentsEndsOnIt) {
  const LineSegment segment{{3, 4}, {-20, 31}};
  const Eigen::Vector3d line = line_of(segment).homogeneous();
  EXPECT_NEAR(line.dot(segment.start.homogeneous()), 0, 1e-12);
  EXPECT_NEAR(line.dot(segment.end.homogeneous()), 0, 1e-12);
  EXPECT_NEAR(line.head<2>().norm(), 1, 1e-12);
}

TEST(LineSegment, LineOfTwoSamplesHasTheVarianceOfTwoSamples) {
  // Samples stand in the middle of the two halves: 10 px apart, each with 0.5 px.
  const ImageLine line = line_of(kAlongU, 0.5, 10);
  EXPECT_DOUBLE_EQ(line.covariance(1, 1), 0.125);
  EXPECT_NEAR(line.covariance(0, 0), 2 * 0.25 / 100, 1e-15);
}

TEST(LineSegment, LineIsLessSureBeyondItsSupport) {
  const ImageLine line = line_of(kAlongU);
  EXPECT_DOUBLE_EQ(line.variance_at({20, 5}), line.covariance(1, 1));
  EXPECT_NEAR(line.variance_at({120, 5}), line.covariance(1, 1) + 1e4 * line.covariance(0, 0),
              1e-12);
}

TEST(LineSegment, LineOfNothingIsRefused) {
  EXPECT_THROW((void)line_of({{1, 1}, {1, 1}}), Error);
  EXPECT_THROW((void)line_of(kAlongU, 0), Error);
}

TEST(FitLine, MeetsExactPointsAndTellsTheirDeviations) {
  const auto line = fit_line({{0, 1}, {1, 2}, {2, 3}}, {0.1, 0.1, 0.1});
  ASSERT_TRUE(line);
  for (const Eigen::Vector2d& p : {Eigen::Vector2d(0, 1), Eigen::Vector2d(2, 3)})
    EXPECT_NEAR(line->homogeneous().dot(p.homogeneous()), 0, 1e-12);
  EXPECT_NEAR(line->covariance(1, 1), 0.01 / 3, 1e-12);
  EXPECT_NEAR(line->covariance(0, 0), 0.01 / 4, 1e-12);  // arms of sqrt(2) on both sides
  EXPECT_NEAR((line->anchor - Eigen::Vector2d(1, 2)).norm(), 0, 1e-12);
}

TEST(FitLine, FindsNoLineInOnePlace) {
  EXPECT_FALSE(fit_line({{1, 1}}, {1}));
  EXPECT_FALSE(fit_line({{1, 1}, {1, 1}, {1, 1}}, {1, 1, 1}));
  EXPECT_THROW((void)fit_line({{1, 1}, {2, 2}}, {1}), Error);
  EXPECT_THROW((void)fit_line({{1, 1}, {2, 2}}, {1, 0}), Error);
}

TEST(FitLine, CovarianceIsThatOfManyNoisyFits) {
  Random random = test::seeded_random(5);
  constexpr int kFits = 2000, kPoints = 20;
  constexpr double kSigma = 0.2;
  const double angle = 0.7;  // of the normal; the line passes through the origin
  const Eigen::Vector2d n(std::cos(angle), std::sin(angle)), along(-n.y(), n.x());
  const Eigen::Vector2d beyond = 80 * along;
  double squared = 0;
  for (int fit = 0; fit < kFits; ++fit) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < kPoints; ++i)
      points.push_back(2.0 * i * along + random.normal(0, kSigma) * n);
    const auto line = fit_line(points, std::vector<double>(kPoints, kSigma));
    ASSERT_TRUE(line);
    const double distance = line->homogeneous().dot(beyond.homogeneous());
    squared += distance * distance / line->variance_at(beyond);
  }
  // Chi-square with 2000 degrees of freedom: deviation sqrt(2 / 2000) = 0.032; five of them.
  EXPECT_NEAR(squared / kFits, 1, 0.16);
}

TEST(Collinearity, SeesAngleDistanceAndGap) {
  const Collinearity apart = collinearity(kAlongU, {{35, 6}, {45, 6}});
  EXPECT_DOUBLE_EQ(apart.angle_rad, 0);
  EXPECT_DOUBLE_EQ(apart.distance_px, 1);
  EXPECT_DOUBLE_EQ(apart.gap_px, 5);
  const Collinearity before = collinearity({{0, 5}, {6, 5}}, kAlongU);
  EXPECT_DOUBLE_EQ(before.gap_px, 4);
  const Collinearity over = collinearity(kAlongU, {{28, 5}, {20, 5}});
  EXPECT_DOUBLE_EQ(over.gap_px, -10);
  EXPECT_DOUBLE_EQ(collinearity(kAlongU, {{20, 0}, {20, 9}}).angle_rad, std::numbers::pi / 2);
}

}  // namespace line_segment_test
}  // namespace placegraph
