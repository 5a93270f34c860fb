#include <gmock/gmock.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/trajectory_edit.h>

#include <algorithm>

#include "tests/support/message_of.h"
#include "tests/support/trajectories.h"

namespace placegraph {
namespace trajectory_edit_test {

using test::message_of;
using testing::HasSubstr;

/// Frames at these times [s], along x at the number of their time.
Trajectory at_times(const std::vector<double>& times_s) {
  Trajectory trajectory;
  for (const double time_s : times_s)
    trajectory.poses.push_back(
        {std::llround(1e9 * time_s), test::isometry({0, 0, 0}, {time_s, 0, 0})});
  return trajectory;
}

std::vector<double> times_of(const Trajectory& trajectory) {
  std::vector<double> times_s;
  for (const StampedPose& pose : trajectory.poses)
    times_s.push_back(static_cast<double>(pose.stamp_ns) / 1e9);
  return times_s;
}

using Stamps = std::vector<std::int64_t>;

Stamps stamps_of(const Trajectory& trajectory) {
  Stamps stamps_ns;
  for (const StampedPose& pose : trajectory.poses) stamps_ns.push_back(pose.stamp_ns);
  return stamps_ns;
}

TEST(TrajectoryEdit, FramesOfATrajectoryWithoutTimesKeepTheirNumbers) {
  const Trajectory drive = test::winding_drive(10, 1, false);
  const Trajectory part = frames_at(drive, {2, 5});
  EXPECT_TRUE(part.numbered);
  EXPECT_FALSE(part.has_times);
  EXPECT_EQ(part.poses[1].stamp_ns, 5);
  EXPECT_EQ(part.poses[1].T_world_body->matrix(), drive.poses[5].T_world_body->matrix());
}

TEST(TrajectoryEdit, BothEndsOfAnIntervalBelongToIt) {
  const Trajectory part = frames_between(at_times({0, 1, 2, 3}), 1'000'000'000, 2'000'000'000);
  EXPECT_EQ(times_of(part), (std::vector<double>{1, 2}));
}

TEST(TrajectoryEdit, AGapIsLongerThanFiveMedianSpacings) {
  EXPECT_EQ(longest_spacing_ns(at_times({0, 1, 2, 3, 9})), 5'000'000'000);
  EXPECT_EQ(longest_spacing_ns(at_times({4})), 0);
}

TEST(TrajectoryEdit, ResampledPosesAreBetweenTheirNeighboursAndNeverAcrossAGap) {
  const Trajectory at = resample(at_times({0, 1, 2, 8, 9}),
                                 {-1, 500'000'000, 2'000'000'000, 5'000'000'000, 8'500'000'000}, 1);
  ASSERT_EQ(at.size(), 5u);
  EXPECT_FALSE(at.poses[0].T_world_body);
  EXPECT_DOUBLE_EQ(at.poses[1].T_world_body->translation().x(), 0.5);
  EXPECT_DOUBLE_EQ(at.poses[2].T_world_body->translation().x(), 2);
  EXPECT_FALSE(at.poses[3].T_world_body);
  EXPECT_DOUBLE_EQ(at.poses[4].T_world_body->translation().x(), 8.5);
}

TEST(TrajectoryEdit, SpacedFramesAreAsFarFromTheLastKeptOneInAnyOfTheDistances) {
  const Trajectory all = at_times({0, 0.4, 0.8, 1.2, 3, 3.1});
  EXPECT_EQ(times_of(spaced(all, {.m = 1.0})), (std::vector<double>{0, 1.2, 3}));
  EXPECT_EQ(times_of(spaced(all, {.s = 0.8})), (std::vector<double>{0, 0.8, 3}));
  Trajectory turning = at_times({0, 0.1, 0.2});
  turning.poses[1].T_world_body->linear() =
      Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_EQ(times_of(spaced(turning, {.m = 5, .deg = 5})), (std::vector<double>{0, 0.1, 0.2}));
  EXPECT_EQ(times_of(spaced(turning, {.deg = 6})), (std::vector<double>{0}));
}

TEST(TrajectoryEdit, RoundedStampsDropNoPoseThatIsDue) {
  Random random(7);
  for (int world = 0; world < 200; ++world) {
    SCOPED_TRACE("world " + std::to_string(world) + " of seed 7");
    // The last digit is a thousandth of the spacing at most; as in files since 1970 or since zero.
    const double period_s = 0.05 * (1 + random.index(6));
    const int step = 2 + random.index(4), digits = 4 + random.index(6);
    const double first_s = random.index(2) * 1'403'636'579.0 + random.uniform(0, 1);
    const double unit_ns = std::pow(10, 9 - digits);
    Trajectory drive;
    Stamps due;
    for (int i = 0; i < 200; ++i) {
      const double time_s = first_s + i * period_s;  // a double, which itself is rounded
      const auto stamp_ns = static_cast<std::int64_t>(
          std::llround(time_s * 1e9 / unit_ns) * std::llround(unit_ns));
      drive.poses.push_back({stamp_ns, test::isometry({0, 0, 0}, {0, 0, 0})});
      if (i % step == 0) due.push_back(stamp_ns);
    }
    EXPECT_EQ(stamps_of(spaced(drive, {.s = step * period_s})), due);
    // What is short of the spacing by more than the rounding is not kept.
    EXPECT_NE(stamps_of(spaced(drive, {.s = 1.01 * step * period_s})), due);
  }
}

TEST(TrajectoryEdit, TheRotationInAPlaneIsTheNearestAboutItsNormal) {
  Random random(11);
  for (int world = 0; world < 50; ++world) {
    SCOPED_TRACE("world " + std::to_string(world) + " of seed 11");
    const int across = random.index(3);
    Eigen::Vector3d w;
    for (double& v : w) v = random.uniform(-1.5, 1.5);
    Trajectory one;
    one.poses.push_back({0, test::isometry(w, {1, 2, 3})});
    const Eigen::Isometry3d in = *in_plane(one, across).poses[0].T_world_body;
    EXPECT_EQ(in.translation()(across), 0);
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(across);
    EXPECT_LT((in.linear() * axis - axis).norm(), 1e-12);
    const auto misfit = [&](double rad) {
      const Eigen::Matrix3d R = in.linear() * Eigen::AngleAxisd(rad, axis).toRotationMatrix();
      return (R - one.poses[0].T_world_body->linear()).norm();
    };
    for (const double rad : {-1.0, -0.1, -1e-3, 1e-3, 0.1, 1.0, 3.0})
      EXPECT_GT(misfit(rad), misfit(0));
  }
}

TEST(TrajectoryEdit, MergesInTheOrderOfTimesWhateverTheOrderOfTheParts) {
  const std::vector<Trajectory> parts = {at_times({0, 1}), at_times({2}), at_times({5, 6})};
  std::vector<int> order = {0, 1, 2};
  do {
    std::vector<Trajectory> shuffled;
    for (const int i : order) shuffled.push_back(parts[static_cast<std::size_t>(i)]);
    const MergedTrajectory merged = merge(shuffled, Overlap::kRefused);
    EXPECT_EQ(times_of(merged.trajectory), (std::vector<double>{0, 1, 2, 5, 6}));
    EXPECT_EQ(merged.left_out, 0u);
  } while (std::ranges::next_permutation(order).found);
}

TEST(TrajectoryEdit, RefusesOverlapsOrKeepsWhatBeginsFirst) {
  const std::vector<Trajectory> parts = {at_times({1, 2, 3}), at_times({0, 1.5, 2})};
  EXPECT_THAT(message_of<ArgumentError>([&] { merge(parts, Overlap::kRefused); }),
              HasSubstr("begins at 1000000000 ns, before the end of an earlier one at 2000000000"));
  const MergedTrajectory merged = merge(parts, Overlap::kFirstKept);
  EXPECT_EQ(times_of(merged.trajectory), (std::vector<double>{0, 1.5, 2, 3}));
  EXPECT_EQ(merged.left_out, 2u);
  Trajectory frames = test::winding_drive(3, 1, false);
  EXPECT_THAT(message_of<ArgumentError>([&] { merge({parts[0], frames}, Overlap::kRefused); }),
              HasSubstr("no times"));
}

TEST(TrajectoryEdit, PartsAtGapsMergeAgainToTheSamePoses) {
  Trajectory all = at_times({0, 1, 2, 10, 11, 12, 20});
  all.poses[1].T_world_body.reset();  // lost, but within a part
  const std::vector<Trajectory> parts = split_at_gaps(all, 5);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(times_of(parts[0]), (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(times_of(merge(parts, Overlap::kRefused).trajectory), times_of(all));
  all.poses[3].T_world_body.reset();  // lost at the begin of a part
  EXPECT_EQ(times_of(split_at_gaps(all, 5)[1]), (std::vector<double>{11, 12}));
}

TEST(TrajectoryEdit, PartsOfALengthBeginAtItsMultiples) {
  const std::vector<Trajectory> parts = split_every(at_times({5, 5.5, 6.9, 7, 20}), 2);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(times_of(parts[0]), (std::vector<double>{5, 5.5, 6.9}));
  EXPECT_EQ(times_of(parts[1]), (std::vector<double>{7}));
  EXPECT_THROW(split_every(parts[0], 0), ArgumentError);
  EXPECT_THROW(split_every(at_times({0, 1e9}), 1e-6), ArgumentError);
}

}  // namespace trajectory_edit_test
}  // namespace placegraph
