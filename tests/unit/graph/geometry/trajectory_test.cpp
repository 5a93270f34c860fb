#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <tests/support/seed.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

namespace placegraph {
namespace trajectory_test {

using Pairs = std::vector<std::pair<int, int>>;

Trajectory at_ms(const std::vector<int>& stamps_ms) {
  Trajectory trajectory;
  for (const int ms : stamps_ms)
    trajectory.poses.push_back({ms * 1'000'000ll, Eigen::Isometry3d::Identity()});
  return trajectory;
}

TEST(Trajectory, PosedCountsFramesThatAreNotLost) {
  Trajectory trajectory = at_ms({0, 10, 20});
  trajectory.poses[1].T_world_body.reset();
  EXPECT_EQ(trajectory.size(), 3u);
  EXPECT_EQ(trajectory.posed(), 2u);
}

TEST(Trajectory, PathLengthPassesLostFramesInAStraightLine) {
  Trajectory trajectory = at_ms({0, 10, 20, 30, 40});
  trajectory.poses[0].T_world_body.reset();
  trajectory.poses[2].T_world_body->translation() = Eigen::Vector3d(3, 0, 0);
  trajectory.poses[3].T_world_body.reset();
  trajectory.poses[4].T_world_body->translation() = Eigen::Vector3d(3, 4, 0);
  EXPECT_DOUBLE_EQ(trajectory.path_length(), 7);
  EXPECT_DOUBLE_EQ(Trajectory().path_length(), 0);
}

TEST(AssociateByTime, PairsTheNearestWithinTheLimit) {
  const auto pairs = associate_by_time(at_ms({0, 100, 200, 300}), at_ms({10, 95, 150, 325}), {});
  EXPECT_EQ(pairs, (Pairs{{0, 0}, {1, 1}}));
}

TEST(AssociateByTime, UsesEachPoseOnceAndGivesItToTheNearest) {
  // Both 0 and 10 are near 8; 10 is nearer, 0 finds nobody else within the limit.
  EXPECT_EQ(associate_by_time(at_ms({0, 10}), at_ms({8}), {}), (Pairs{{1, 0}}));
  // 0 takes what is left: -9.
  EXPECT_EQ(associate_by_time(at_ms({0, 10}), at_ms({-9, 8}), {}), (Pairs{{0, 0}, {1, 1}}));
}

TEST(AssociateByTime, NeverCrossesPairs) {
  // Closest first: (6, 7); then 0 lies before it and 14 after: they may not be joined.
  EXPECT_EQ(associate_by_time(at_ms({6, 14}), at_ms({0, 7}), {0.05, 0}), (Pairs{{0, 1}}));
}

TEST(AssociateByTime, PairsLostFramesToo) {
  Trajectory a = at_ms({0, 100});
  a.poses[0].T_world_body.reset();
  EXPECT_EQ(associate_by_time(a, at_ms({0, 100}), {}), (Pairs{{0, 0}, {1, 1}}));
}

TEST(AssociateByTime, AddsTheOffsetToTheSecond) {
  EXPECT_EQ(associate_by_time(at_ms({1000, 1100}), at_ms({0, 100}), {0.02, 1.0}),
            (Pairs{{0, 0}, {1, 1}}));
}

TEST(AssociateByTime, LimitIsInclusiveAndExactInNanoseconds) {
  EXPECT_EQ(associate_by_time(at_ms({0}), at_ms({20}), {0.02, 0}).size(), 1u);
  EXPECT_EQ(associate_by_time(at_ms({0}), at_ms({21}), {0.02, 0}).size(), 0u);
  // Stamps of today need more digits than a double has seconds for.
  Trajectory a, b;
  a.poses.push_back({1'700'000'000'000'000'000, {}});
  b.poses.push_back({1'700'000'000'000'000'001, {}});
  EXPECT_EQ(associate_by_time(a, b, {0, 0}).size(), 0u);
  EXPECT_EQ(associate_by_time(a, a, {0, 0}).size(), 1u);
}

TEST(AssociateByTime, IsTheGreedyClosestPairsThatDoNotCross) {
  Random random = test::seeded_random(21);
  for (int trial = 0; trial < 200; ++trial) {
    const auto draw = [&] {
      std::vector<int> stamps;
      for (int ms = 0, n = random.index(12); n > 0; --n)
        stamps.push_back(ms += 1 + random.index(9));
      return stamps;
    };
    const std::vector<int> a = draw(), b = draw();
    // By definition: all candidates, closest first, refused if they cross or reuse.
    struct Candidate {
      int difference, i, j;
    };
    std::vector<Candidate> candidates;
    for (int i = 0; i < static_cast<int>(a.size()); ++i)
      for (int j = 0; j < static_cast<int>(b.size()); ++j)
        if (std::abs(a[i] - b[j]) <= 6) candidates.push_back({std::abs(a[i] - b[j]), i, j});
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& x, const Candidate& y) {
      return std::tie(x.difference, x.i, x.j) < std::tie(y.difference, y.i, y.j);
    });
    Pairs expected;
    for (const Candidate& c : candidates) {
      bool free = true;
      for (const auto& [i, j] : expected) free = free && (c.i - i) * (c.j - j) > 0;
      if (free) expected.emplace_back(c.i, c.j);
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(associate_by_time(at_ms(a), at_ms(b), {0.006, 0}), expected);
  }
}

TEST(AssociateByTime, RefusesStampsThatDoNotIncrease) {
  EXPECT_THROW(associate_by_time(at_ms({0, 10, 10}), at_ms({0}), {}), ArgumentError);
  EXPECT_THROW(associate_by_time(at_ms({0}), at_ms({20, 10}), {}), ArgumentError);
}

TEST(AssociateByTime, RefusesOptionsThatAreNoTimes) {
  EXPECT_THROW(associate_by_time(at_ms({0}), at_ms({0}), {-1, 0}), ArgumentError);
  EXPECT_THROW(associate_by_time(at_ms({0}), at_ms({0}), {0.02, NAN}), ArgumentError);
}

TEST(AssociateByTime, OfNothingIsNothing) {
  EXPECT_TRUE(associate_by_time({}, at_ms({0}), {}).empty());
  EXPECT_TRUE(associate_by_time(at_ms({0}), {}, {}).empty());
}

Trajectory quarter_turn() {
  Trajectory trajectory = at_ms({0, 100});
  trajectory.poses[0].T_world_body = SE3(SO3(), {0, 0, 0}).isometry();
  trajectory.poses[1].T_world_body =
      SE3(SO3::exp({0, 0, std::numbers::pi / 2}), {4, 0, 8}).isometry();
  return trajectory;
}

TEST(Interpolate, MovesLinearlyAndRotatesAlongTheGeodesic) {
  const auto T = interpolate(quarter_turn(), 25'000'000);
  ASSERT_TRUE(T);
  EXPECT_NEAR((T->translation() - Eigen::Vector3d(1, 0, 2)).norm(), 0, 1e-14);
  EXPECT_NEAR((T->rotation().log() - Eigen::Vector3d(0, 0, std::numbers::pi / 8)).norm(), 0, 1e-14);
}

TEST(Interpolate, ReturnsTheGivenPosesAtTheirStamps) {
  const auto T = interpolate(quarter_turn(), 100'000'000);
  ASSERT_TRUE(T);
  EXPECT_EQ(T->translation(), Eigen::Vector3d(4, 0, 8));
  EXPECT_TRUE(interpolate(quarter_turn(), 0));
}

TEST(Interpolate, GivesNothingOutside) {
  EXPECT_FALSE(interpolate(quarter_turn(), -1));
  EXPECT_FALSE(interpolate(quarter_turn(), 100'000'001));
  EXPECT_FALSE(interpolate({}, 0));
}

TEST(Interpolate, GivesNothingBesideALostFrame) {
  Trajectory trajectory = at_ms({0, 100, 200});
  trajectory.poses[1].T_world_body.reset();
  EXPECT_FALSE(interpolate(trajectory, 50'000'000));
  EXPECT_FALSE(interpolate(trajectory, 100'000'000));
  EXPECT_FALSE(interpolate(trajectory, 150'000'000));
  EXPECT_TRUE(interpolate(trajectory, 200'000'000));
}

TEST(Interpolate, GivesNothingAcrossAGap) {
  EXPECT_FALSE(interpolate(at_ms({0, 1001}), 500'000'000));
  EXPECT_TRUE(interpolate(at_ms({0, 1001}), 500'000'000, 2.0));
  EXPECT_TRUE(interpolate(at_ms({0, 1000}), 500'000'000));
}

}  // namespace trajectory_test
}  // namespace placegraph
