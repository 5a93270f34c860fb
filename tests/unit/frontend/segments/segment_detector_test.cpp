#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/frontend/segments/edge_refinement.h>
#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/frontend/segments/segment_merging.h>
#include <placegraph/graph/core/error.h>

#include <cmath>

#include "tests/support/scenes/tiles.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace segment_detector_test {

using Eigen::Vector2d;

TEST(SegmentMerging, JoinsPiecesOfOneEdge) {
  const auto merged =
      merge_segments({{{0, 0}, {20, 0}}, {{50, 30}, {50, 60}}, {{26, 0.4}, {50, 0.4}}});
  ASSERT_EQ(merged.size(), 2u);
  EXPECT_NEAR((merged[0].start - Vector2d(0, 0)).norm(), 0, 0.5);
  EXPECT_NEAR((merged[0].end - Vector2d(50, 0.4)).norm(), 0, 0.5);
  EXPECT_EQ(merged[1].start, Vector2d(50, 30));
}

TEST(SegmentMerging, LeavesApartWhatIsNotOneEdge) {
  const LineSegment base{{0, 0}, {20, 0}};
  EXPECT_EQ(merge_segments({base, {{35, 0}, {60, 0}}}).size(), 2u) << "gap";
  EXPECT_EQ(merge_segments({base, {{22, 2}, {60, 2}}}).size(), 2u) << "distance";
  EXPECT_EQ(merge_segments({base, {{40, 0}, {22, 0}}}).size(), 2u) << "polarity";
  EXPECT_EQ(merge_segments({base, {{21, 0}, {40, 1.1}}}).size(), 2u) << "angle";
}

TEST(SegmentMerging, ChainThatBendsStaysInPieces) {
  std::vector<LineSegment> arc;
  for (int i = 0; i < 12; ++i) {  // 1.7 degrees from each to the next
    const auto at = [](double k) {
      return Vector2d(400 * std::sin(0.03 * k), 400 * std::cos(0.03 * k));
    };
    arc.push_back({at(i), at(i + 0.9)});
  }
  EXPECT_EQ(merge_segments(arc).size(), 12u);
}

TEST(EdgeRefiner, FindsAnEdgeWithinAFewHundredthsOfAPixel) {
  for (double angle : {0.0, 0.3, 1.1, 2.0, 3.5, 5.2}) {
    SCOPED_TRACE(angle);
    const Vector2d n(std::cos(angle), std::sin(angle)), along(-n.y(), n.x()), middle(60.3, 49.6);
    const Image image = test::half_planes(120, 100, angle, n.dot(middle));
    const LineSegment rough{middle - 30 * along + 1.2 * n, middle + 30 * along - 0.8 * n};
    const auto edge = EdgeRefiner(image).refine(rough);
    ASSERT_TRUE(edge);
    for (const Vector2d& end : {edge->segment.start, edge->segment.end})
      EXPECT_NEAR(n.dot(end - middle), 0, 0.05);
    EXPECT_GT(edge->segment.normal().dot(n), 0.99) << "brighter side on the right";
    EXPECT_NEAR(edge->segment.length(), 60, 0.1);
  }
}

TEST(EdgeRefiner, CovarianceIsHonestUnderNoise) {
  Random random = test::seeded_random(8);
  constexpr int kTrials = 600;
  double squared = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double angle = random.uniform(0, 6.28);
    const Vector2d n(std::cos(angle), std::sin(angle)), along(-n.y(), n.x());
    const Vector2d middle(40 + random.uniform(0, 1), 40 + random.uniform(0, 1));
    const Image image =
        test::disturbed(test::half_planes(80, 80, angle, n.dot(middle), 90, 130), 6, random);
    const auto edge = EdgeRefiner(image).refine({middle - 25 * along, middle + 25 * along});
    ASSERT_TRUE(edge);
    const Vector2d m = edge->line.normal().dot(n) > 0 ? edge->line.normal() : -edge->line.normal();
    const double rotation = std::atan2(n.x() * m.y() - n.y() * m.x(), n.dot(m));
    const double shift = n.dot(edge->line.anchor - middle);
    squared += rotation * rotation / edge->line.covariance(0, 0) +
               shift * shift / edge->line.covariance(1, 1);
  }
  const double per_degree_of_freedom = squared / (2 * kTrials);
  // Known to 4 %; some 1.5 as it is, deviations are 1.2 times too small.
  EXPECT_GT(per_degree_of_freedom, 0.4);
  EXPECT_LT(per_degree_of_freedom, 1.6);
}

TEST(EdgeRefiner, SeesNoEdgeWhereNoneIs) {
  const Image flat(60, 60, CV_8UC1, cv::Scalar(90));
  EXPECT_FALSE(EdgeRefiner(flat).refine({{10, 30}, {50, 30}}));
  const Image edge = test::half_planes(60, 60, 0, 30);
  EXPECT_FALSE(EdgeRefiner(edge).refine({{10, 30}, {50, 30}})) << "across the edge";
  EXPECT_FALSE(EdgeRefiner(edge).refine({{30, 10}, {30, 12}})) << "too short";
  EXPECT_THROW(EdgeRefiner{Image()}, Error);
}

TEST(SegmentDetector, FindsTheEdgesOfTiles) {
  Random random = test::seeded_random(4);
  const test::TiledWall wall(3, 2, 60, random);
  const Eigen::Matrix3d H = (Eigen::Matrix3d() << 0.97, -0.2, 40, 0.2, 0.97, 8, 0, 0, 1).finished();
  const auto edges = detect_segments(wall.seen(240, 180, H), {});
  const auto truth = wall.edges(H);
  int found = 0;
  for (const LineSegment& side : truth)
    for (const EdgeSegment& edge : edges) {
      const Collinearity lie = collinearity(side, edge.segment);
      const bool same = lie.distance_px < 0.3 && edge.segment.length() > 0.8 * side.length() &&
                        (edge.segment.middle() - side.middle()).norm() < 0.2 * side.length();
      found += same;
    }
  EXPECT_GE(found, static_cast<int>(0.9 * static_cast<double>(truth.size())));
  EXPECT_LE(edges.size(), truth.size() + 3);
  EXPECT_TRUE(std::is_sorted(edges.begin(), edges.end(), [](const auto& x, const auto& y) {
    return x.segment.length() > y.segment.length();
  }));
}

TEST(SegmentDetector, LeavesOutTheBorderOfThePicture) {
  Image framed(80, 100, CV_8UC1, cv::Scalar(150));
  framed.colRange(0, 2).setTo(0);
  EXPECT_THAT(detect_segments(framed, {}), testing::IsEmpty());
  SegmentDetectorOptions options;
  options.border_px = 0;
  EXPECT_EQ(detect_segments(framed, options).size(), 1u);
}

TEST(SegmentDetector, WantsAGreyImage) {
  EXPECT_THROW((void)detect_segments(Image(), {}), Error);
  EXPECT_THROW((void)detect_segments(Image(50, 50, CV_8UC3), {}), Error);
}

}  // namespace segment_detector_test
}  // namespace placegraph
