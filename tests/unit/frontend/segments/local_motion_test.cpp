#include <gtest/gtest.h>
#include <placegraph/frontend/segments/local_motion.h>
#include <placegraph/frontend/segments/segment_merging.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace placegraph {
namespace local_motion_test {

using Eigen::Matrix2d;
using Eigen::Vector2d;

TEST(LocalMotionField, MovesWithBothImages) {
  // The rows of the equations are taken from the middle of the segment: where the images have their
  // origins does not matter.
  Random random(1);
  std::vector<PointPair> points, moved;
  const Vector2d by_a(200, -90), by_b(-40, 300);
  for (int i = 0; i < 12; ++i) {
    const Vector2d px(random.uniform(0, 100), random.uniform(0, 100));
    points.push_back(
        {px, {1.2 * px.x() + random.normal(), px.y() + random.normal()}, Matrix2d::Identity()});
    moved.push_back({px + by_a, points.back().px_b + by_b, Matrix2d::Identity()});
  }
  const LineSegment a{{30, 40}, {70, 50}}, there{a.start + by_a, a.end + by_a};
  const auto motion = LocalMotionField(points).around(a),
             other = LocalMotionField(moved).around(there);
  ASSERT_TRUE(motion && other);
  EXPECT_LT((motion->A - other->A).norm(), 1e-6);
  EXPECT_LT(((*motion)(a.start) + by_b - (*other)(there.start)).norm(), 1e-6);
  EXPECT_NEAR(motion->rms_px, other->rms_px, 1e-6);
  EXPECT_NEAR(motion->distance_px, other->distance_px, 1e-9);
}

TEST(LocalMotionField, AsksTheNearestEvidenceAlone) {
  // Near the segment everything is shifted by (3, 4); farther away by something else.
  std::vector<PointPair> points;
  for (int i = 0; i < 5; ++i) {
    const Vector2d near(10.0 * i, 12.0 * (i % 2)), far(10.0 * i, 200 + 12.0 * (i % 2));
    points.push_back({far, far + Vector2d(-50, 20), Matrix2d::Identity()});
    points.push_back({near, near + Vector2d(3, 4), Matrix2d::Identity()});
  }
  const auto motion = LocalMotionField(points, {}, 5).around({{0, 5}, {40, 5}});
  ASSERT_TRUE(motion);
  EXPECT_LT((motion->A - Matrix2d::Identity()).norm(), 1e-6);
  EXPECT_LT((motion->t - Vector2d(3, 4)).norm(), 1e-5);
  EXPECT_NEAR(motion->rms_px, 0, 1e-5);
  EXPECT_LT(motion->distance_px, 8);
}

TEST(LocalMotionField, RefusesAMapThatMirrors) {
  std::vector<PointPair> points;
  for (int i = 0; i < 9; ++i) {
    const Vector2d px(40.0 * (i % 3), 40.0 * (i / 3));
    points.push_back({px, {-px.x(), px.y()}, Matrix2d::Identity()});
  }
  EXPECT_FALSE(LocalMotionField(points).around({{10, 40}, {70, 40}}));
}

TEST(MergeSegments, DoesNotCareForOrderPlaceOrDirection) {
  // Pieces of three edges, in any order: always the same three.
  const std::vector<LineSegment> pieces = {{{0, 0}, {20, 0}},        {{26, 0.3}, {50, 0.3}},
                                           {{55, 0.1}, {90, 0}},     {{10, 40}, {10, 70}},
                                           {{10.4, 75}, {10.4, 99}}, {{60, 60}, {80, 90}}};
  const auto merged_after = [&](double turn, const Vector2d& shift, Random& random) {
    Matrix2d R;
    R << std::cos(turn), -std::sin(turn), std::sin(turn), std::cos(turn);
    std::vector<LineSegment> moved;
    for (const LineSegment& piece : pieces)
      moved.push_back({R * piece.start + shift, R * piece.end + shift});
    for (std::size_t i = moved.size() - 1; i > 0; --i)
      std::swap(moved[i], moved[random.index(static_cast<int>(i) + 1)]);
    std::vector<LineSegment> back;
    for (const LineSegment& whole : merge_segments(moved))
      back.push_back({R.transpose() * (whole.start - shift), R.transpose() * (whole.end - shift)});
    std::sort(back.begin(), back.end(),
              [](const LineSegment& a, const LineSegment& b) { return a.length() < b.length(); });
    return back;
  };
  Random random(2);
  const std::vector<LineSegment> once = merged_after(0, {0, 0}, random);
  ASSERT_EQ(once.size(), 3u);
  EXPECT_NEAR(once[1].length(), 59, 0.1);
  EXPECT_NEAR(once[2].length(), 90, 0.1);
  for (int round = 0; round < 10; ++round) {
    const std::vector<LineSegment> again = merged_after(
        random.uniform(0, 6), {random.uniform(-500, 500), random.uniform(-500, 500)}, random);
    ASSERT_EQ(again.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LT((again[i].start - once[i].start).norm(), 1e-6);
      EXPECT_LT((again[i].end - once[i].end).norm(), 1e-6);
    }
  }
  EXPECT_TRUE(merge_segments({}).empty());
}

}  // namespace local_motion_test
}  // namespace placegraph
