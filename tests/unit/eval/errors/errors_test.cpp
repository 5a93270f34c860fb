#include <gtest/gtest.h>
#include <placegraph/eval/errors/ape.h>
#include <placegraph/eval/errors/kitti_segments.h>
#include <placegraph/eval/errors/relative_error.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <numbers>

#include "tests/support/trajectories.h"

namespace placegraph {
namespace errors_test {

using test::isometry;

// A straight line of 1 m steps along z at 10 Hz; the estimate turns by `yaw` every frame, or is
// `scale` times as long.
std::vector<FramePair> straight_line(int frames, double yaw, double scale = 1) {
  std::vector<FramePair> pairs;
  Eigen::Isometry3d T_world_estimate = Eigen::Isometry3d::Identity();
  for (int i = 0; i < frames; ++i) {
    FramePair pair;
    pair.frame = i;
    pair.stamp_ns = i * 100'000'000LL;
    pair.T_world_truth = isometry({0, 0, 0}, {0, 0, static_cast<double>(i)});
    pair.T_world_estimate = T_world_estimate;
    pairs.push_back(pair);
    T_world_estimate = T_world_estimate * isometry({0, yaw, 0}, {0, 0, scale});
  }
  return pairs;
}

SegmentOptions lengths(std::vector<double> lengths_m, int step) {
  SegmentOptions options;
  options.lengths_m = std::move(lengths_m);
  options.step = step;
  return options;
}

TEST(Statistics, MatchHandComputedValues) {
  const Statistics odd = statistics_of({3, 1, 2});
  EXPECT_DOUBLE_EQ(odd.mean, 2);
  EXPECT_DOUBLE_EQ(odd.median, 2);
  EXPECT_DOUBLE_EQ(odd.max, 3);
  EXPECT_DOUBLE_EQ(odd.rmse, std::sqrt(14.0 / 3));
  EXPECT_EQ(odd.count, 3);
  EXPECT_DOUBLE_EQ(statistics_of({4, 1, 2, 3}).median, 2.5);
  EXPECT_THROW((void)statistics_of({}), ArgumentError);
}

TEST(Statistics, OfErrorsWithSignsHaveExtremesOfTheirMagnitudes) {
  const Statistics s = signed_statistics_of({-5, 1, 2, -1});
  EXPECT_DOUBLE_EQ(s.mean, -0.75);
  EXPECT_DOUBLE_EQ(s.median, 0);
  EXPECT_DOUBLE_EQ(s.min, 1);
  EXPECT_DOUBLE_EQ(s.max, 5);
  EXPECT_DOUBLE_EQ(s.p75, 2.75);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(31.0 / 4));
  EXPECT_DOUBLE_EQ(s.std_dev, std::sqrt(31.0 / 4 - 0.75 * 0.75));
}

TEST(Ape, MeasuresDistancesOfPosedFramesOnly) {
  std::vector<FramePair> pairs(3);
  for (int i = 0; i < 3; ++i) pairs[static_cast<std::size_t>(i)].frame = 10 + i;
  pairs[0].T_world_estimate = isometry({0, 0, 0}, {3, 4, 0});
  pairs[2].T_world_estimate = isometry({1, 0, 0}, {0, 0, 1});
  const ApeResult result = ape(pairs);
  ASSERT_TRUE(result.outcome);
  EXPECT_EQ(result.frames, (std::vector<int>{10, 12}));
  EXPECT_EQ(result.frame_errors_m, (std::vector<double>{5, 1}));
  EXPECT_DOUBLE_EQ(result.error_m.rmse, std::sqrt(13.0));
}

TEST(Ape, SaysThatNoPosedFrameAllowsNoError) {
  EXPECT_EQ(ape(std::vector<FramePair>(3)).outcome.code, Outcome::Code::kTooFewData);
}

TEST(Rpe, MeasuresAConstantYawAndLengthErrorExactly) {
  const RelativeErrors result = relative_errors(straight_line(20, 0.5 * kRadPerDeg, 1.1), true, {});
  ASSERT_TRUE(result.outcome);
  EXPECT_EQ(result.rotation_deg.count, 19);
  EXPECT_NEAR(result.rotation_deg.rmse, 0.5, 1e-9);
  EXPECT_NEAR(result.rotation_deg.median, 0.5, 1e-9);
  EXPECT_NEAR(result.translation_m.rmse, 0.1, 1e-12);
}

TEST(Rpe, LeavesOutPairsWithALostFrame) {
  std::vector<FramePair> pairs = straight_line(5, 0);
  pairs[2].T_world_estimate.reset();
  EXPECT_EQ(relative_errors(pairs, true, {}).translation_m.count, 2);
  pairs[0].T_world_estimate.reset();
  pairs[4].T_world_estimate.reset();
  EXPECT_EQ(relative_errors(pairs, true, {}).outcome.code, Outcome::Code::kTooFewData);
}

TEST(RotationAngle, SeesAHundredthDegreeInMatricesOfSevenDigits) {
  Eigen::Matrix3d R = isometry({0, 0.01 * kRadPerDeg, 0}, {0, 0, 0}).linear();
  R = (R * 1e7).array().round() / 1e7;
  EXPECT_NEAR(rotation_angle(R) / kRadPerDeg, 0.01,
              1e-5);  // half a unit of the 7th digit: 3e-6 deg
  EXPECT_NEAR(rotation_angle(isometry({0, 3.0, 0}, {0, 0, 0}).linear()), 3.0, 1e-12);
}

TEST(KittiSegments, EndAtTheFirstFrameBeyondTheLength) {
  // 1 m a frame: the path behind frame 10 is exactly 10 m, which is not more than 10 m.
  const SegmentResult result = kitti_segments(straight_line(26, 0), true, lengths({10}, 7));
  ASSERT_TRUE(result.outcome);
  ASSERT_EQ(result.segments.size(), 3u);  // starts 0, 7, 14; 21 + 11 is beyond the end
  EXPECT_EQ(result.segments[0].first_frame, 0);
  EXPECT_EQ(result.segments[0].last_frame, 11);
  EXPECT_EQ(result.segments[2].first_frame, 14);
  EXPECT_EQ(result.segments[2].last_frame, 25);
  EXPECT_NEAR(result.segments[0].speed_m_per_s, 10 / 1.1, 1e-12);
}

TEST(KittiSegments, MeasureAConstantYawErrorOnAStraightLineExactly) {
  // Between i and j = i + 11 the estimate turns by 11 yaw and moves sum_k Ry(k yaw) (0 0 1), so
  // E = estimate^-1 truth has the angle 11 yaw and |trans E| = |(0 0 11) - sum_k Ry(k yaw) e_z|.
  const double yaw = 0.2 * kRadPerDeg;
  Eigen::Vector3d end(0, 0, 0);
  for (int k = 0; k < 11; ++k) end += Eigen::Vector3d(std::sin(k * yaw), 0, std::cos(k * yaw));
  const double t_percent = (Eigen::Vector3d(0, 0, 11) - end).norm() / 10 * 100;
  const SegmentResult result = kitti_segments(straight_line(200, yaw), true, lengths({10}, 1));
  ASSERT_TRUE(result.outcome);
  EXPECT_EQ(result.segments.size(), 189u);
  EXPECT_NEAR(result.t_rel_percent, t_percent, 1e-9);
  EXPECT_NEAR(result.r_rel_deg_per_100m, 11 * 0.2 / 10 * 100, 1e-6);
}

TEST(KittiSegments, AverageOverSegmentsAndGroupByLength) {
  // A 10 % longer estimate is wrong by 10 % of the true length from i to j: (L + 1) / L times 10 %.
  const SegmentResult result =
      kitti_segments(straight_line(40, 0, 1.1), true, lengths({20, 10}, 10));
  ASSERT_TRUE(result.outcome);
  ASSERT_EQ(result.by_length.size(), 2u);
  EXPECT_EQ(result.by_length[0].from, 10);
  EXPECT_EQ(result.by_length[0].segments, 3);  // starts 0 10 20
  EXPECT_EQ(result.by_length[1].segments, 2);  // starts 0 10
  EXPECT_NEAR(result.by_length[0].t_percent, 11.0, 1e-9);
  EXPECT_NEAR(result.by_length[1].t_percent, 10.5, 1e-9);
  EXPECT_NEAR(result.t_rel_percent, (3 * 11.0 + 2 * 10.5) / 5, 1e-9);
}

TEST(KittiSegments, GroupBySpeedFromTimesOrTheFrameRate) {
  const SegmentResult timed = kitti_segments(straight_line(60, 0), true, lengths({10, 50}, 10));
  ASSERT_EQ(timed.by_speed.size(), 1u);  // 10/1.1 = 9.09 and 50/5.1 = 9.80 m/s
  EXPECT_EQ(timed.by_speed[0].from, 8);
  EXPECT_EQ(timed.by_speed[0].to, 10);
  EXPECT_EQ(timed.by_speed[0].segments, 6);  // five of 10 m and one of 50 m
  SegmentOptions slower = lengths({10, 50}, 10);
  slower.frame_rate_hz = 1;
  const SegmentResult indexed = kitti_segments(straight_line(60, 0), false, slower);
  EXPECT_EQ(indexed.by_speed[0].from, 0);
}

TEST(KittiSegments, CountSegmentsThatALostFrameTakesAway) {
  std::vector<FramePair> pairs = straight_line(30, 0);
  pairs[11].T_world_estimate.reset();
  const SegmentResult result = kitti_segments(pairs, true, lengths({10}, 10));
  EXPECT_EQ(result.skipped, 1);
  EXPECT_EQ(result.segments.size(), 1u);
}

TEST(KittiSegments, SayThatAPathIsTooShort) {
  const SegmentResult result = kitti_segments(straight_line(50, 0), true, SegmentOptions{});
  EXPECT_EQ(result.outcome.code, Outcome::Code::kTooFewData);
  EXPECT_EQ(result.outcome.reason, "the path of 49 m is too short for segments of 100 m");
}

TEST(KittiSegments, RefuseAnEmptyListAndNegativeLengths) {
  EXPECT_THROW(lengths({}, 1).check(), ArgumentError);
  EXPECT_THROW(lengths({-5}, 1).check(), ArgumentError);
  EXPECT_THROW(lengths({5}, 0).check(), ArgumentError);
}

}  // namespace errors_test
}  // namespace placegraph
