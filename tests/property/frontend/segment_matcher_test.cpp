#include <gtest/gtest.h>
#include <placegraph/frontend/segments/segment_matcher.h>

#include "tests/support/scenes/tiles.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace segment_matcher_test {

/// A wall of tiles seen twice; homographies from the wall.
class TwoViews : public testing::Test {
 protected:
  Random random = test::seeded_random(11);
  test::TiledWall wall{5, 4, 60, random};
  Eigen::Matrix3d H_a = Eigen::Matrix3d::Identity(), H_b = Eigen::Matrix3d::Identity();

  void expect_truth(double least_recall) {
    const Image a = wall.seen(300, 240, H_a);
    const Image b = test::disturbed(wall.seen(320, 260, H_b), 2, random, 0.8, 15);
    const std::vector<LineSegment> edges_a = wall.edges(H_a);
    std::vector<LineSegment> edges_b = wall.edges(H_b);
    for (LineSegment& edge : edges_b) std::swap(edge.start, edge.end);  // the sense is not used
    const SegmentMatches found = match_segments(a, edges_a, b, edges_b, {});
    ASSERT_TRUE(found.outcome) << found.outcome.reason;
    int right = 0;
    for (const SegmentMatch& match : found.matches) right += match.a == match.b;
    EXPECT_EQ(right, static_cast<int>(found.matches.size())) << "every match is a true one";
    EXPECT_GE(right, least_recall * static_cast<double>(edges_a.size()));
  }
};

TEST_F(TwoViews, AreMatchedThroughRotationScaleAndLight) {
  H_b << 0.85, -0.45, 100, 0.45, 0.85, -20, 0, 0, 1;
  expect_truth(0.7);
}

TEST_F(TwoViews, AreMatchedThroughPerspective) {
  H_b << 0.75, 0.05, 20, -0.1, 0.95, 30, -0.0008, 0.0001, 1;
  expect_truth(0.7);
}

}  // namespace segment_matcher_test
}  // namespace placegraph
