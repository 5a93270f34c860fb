#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/kitti/kitti_figures.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/support/data.h"
#include "tests/support/seed.h"
#include "tests/support/trajectories.h"

namespace placegraph {
namespace kitti_figures_test {

/// Pairs of a drive and of what was estimated of it.
std::vector<FramePair> pairs_of(const Trajectory& truth, const Trajectory& estimate) {
  std::vector<FramePair> pairs;
  for (std::size_t i = 0; i < truth.size(); ++i)
    pairs.push_back({static_cast<int>(i), static_cast<std::int64_t>(i),
                     *truth.poses[i].T_world_body, *estimate.poses[i].T_world_body});
  return pairs;
}

/// A drive straight ahead, a metre a frame, and an estimate of it with another scale that turns
/// about y by an angle a frame without leaving the line.
std::vector<FramePair> straight_drive(int frames, double scale, double turn_rad) {
  std::vector<Eigen::Isometry3d> truth, estimate;
  for (int i = 0; i < frames; ++i) {
    truth.push_back(test::isometry({0, 0, 0}, {0, 0, 1.0 * i}));
    estimate.push_back(test::isometry({0, turn_rad * i, 0}, {0, 0, scale * i}));
  }
  return pairs_of(test::trajectory_of(truth, false), test::trajectory_of(estimate, false));
}

std::vector<SegmentError> segments_of(const std::vector<FramePair>& pairs) {
  return kitti_segments(pairs, false, SegmentOptions()).segments;
}

// The end of a segment lies strictly beyond its length: at metre 101 of 100, at 201 of 200. A scale
// of 1.01 is off by 1.01 m and by 2.01 m there. 301 frames have 20 segments of 100 m (from frame 0,
// 10, ... 190) and 10 of 200 m.
TEST(KittiFigures, AreThoseThatOneComputesByHandForAStraightLine) {
  const std::vector<SegmentError> segments = segments_of(straight_drive(301, 1.01, 0));
  const KittiFigures figures = kitti_figures(segments);
  ASSERT_TRUE(figures.outcome);
  EXPECT_EQ(figures.segments, 30);
  EXPECT_NEAR(figures.t_rel_percent, (20 * 1.01 + 10 * 1.005) / 30, 1e-12);
  EXPECT_NEAR(figures.r_rel_deg_per_100m, 0, 1e-12);
  EXPECT_EQ(kitti_stats_text(figures), "0.010083 0.000000\n");
  EXPECT_EQ(kitti_translations_text(figures.by_length),
            "100.000000 0.010100\n200.000000 0.010050\n");
  // 102 frames for 100 m are 9.80 m/s, 202 for 200 m are 9.90: both within 2 m/s of 8 and of 10.
  const double mean = (20 * 0.0101 + 10 * 0.01005) / 30;
  EXPECT_EQ(kitti_translations_text(figures.by_speed),
            fmt::format("8.000000 {:f}\n10.000000 {:f}\n", mean, mean));
  const std::string text = kitti_segments_text(segments);
  EXPECT_THAT(text, testing::StartsWith("0 0.000000 0.010100 100.000000 9.803922\n"
                                        "0 0.000000 0.010050 200.000000 9.900990\n"
                                        "10 0.000000 0.010100 100.000000 9.803922\n"));
  EXPECT_EQ(std::ranges::count(text, '\n'), 30);
}

TEST(KittiFigures, RotationsAreInRadiansAMetreInTheFilesOfTheDevkit) {
  // A milliradian a frame: 101 of them over 100 m.
  const KittiFigures figures = kitti_figures(segments_of(straight_drive(150, 1, 1e-3)));
  EXPECT_EQ(kitti_rotations_text(figures.by_length), "100.000000 0.001010\n");
  EXPECT_NEAR(figures.r_rel_deg_per_100m, 101 * 1e-3 * 180 / std::numbers::pi, 1e-6);
}

TEST(KittiFigures, ARowNeedsThreeSegments) {
  // 122 frames have segments of 100 m from the frames 0, 10 and 20; 121 lack the last.
  EXPECT_EQ(kitti_figures(segments_of(straight_drive(122, 1.01, 0))).by_length.size(), 1u);
  const KittiFigures two = kitti_figures(segments_of(straight_drive(121, 1.01, 0)));
  EXPECT_EQ(two.segments, 2);
  EXPECT_NEAR(two.t_rel_percent, 1.01, 1e-12);
  EXPECT_TRUE(two.by_length.empty());
  EXPECT_TRUE(two.by_speed.empty());
}

TEST(KittiFigures, ThereAreNoneOfADriveShorterThanASegment) {
  const KittiFigures figures = kitti_figures(segments_of(straight_drive(101, 1.01, 0)));
  EXPECT_EQ(figures.outcome.code, Outcome::Code::kTooFewData);
  EXPECT_EQ(figures.segments, 0);
}

/// The devkit's definition of one table, in plain loops: means of all segments within `radius` of
/// every `at`, with matrices inverted as a whole.
struct Devkit {
  std::vector<double> first, length, t, r, speed;

  explicit Devkit(const std::vector<FramePair>& pairs) {
    std::vector<double> distance = {0};
    for (std::size_t i = 1; i < pairs.size(); ++i)
      distance.push_back(
          distance.back() +
          (pairs[i].T_world_truth.translation() - pairs[i - 1].T_world_truth.translation()).norm());
    for (std::size_t i = 0; i < pairs.size(); i += 10)
      for (double metres = 100; metres < 850; metres += 100) {
        std::size_t j = i;
        while (j < pairs.size() && distance[j] <= distance[i] + metres) ++j;
        if (j == pairs.size()) continue;
        const Eigen::Matrix4d truth =
            pairs[i].T_world_truth.matrix().inverse() * pairs[j].T_world_truth.matrix();
        const Eigen::Matrix4d estimate =
            pairs[i].T_world_estimate->matrix().inverse() * pairs[j].T_world_estimate->matrix();
        const Eigen::Matrix4d error = estimate.inverse() * truth;
        first.push_back(static_cast<double>(i));
        length.push_back(metres);
        t.push_back(error.block<3, 1>(0, 3).norm() / metres);
        r.push_back(
            std::acos(std::clamp(0.5 * (error(0, 0) + error(1, 1) + error(2, 2) - 1), -1.0, 1.0)) /
            metres);
        speed.push_back(metres / (0.1 * static_cast<double>(j - i + 1)));
      }
  }

  /// Lines of a table, compared number by number.
  std::vector<std::array<double, 3>> rows(const std::vector<double>& key, double begin, double end,
                                          double step, double radius) const {
    std::vector<std::array<double, 3>> rows;
    for (double at = begin; at < end; at += step) {
      double sum_t = 0, sum_r = 0, count = 0;
      for (std::size_t k = 0; k < key.size(); ++k)
        if (std::abs(key[k] - at) < radius) sum_t += t[k], sum_r += r[k], ++count;
      if (count > 2.5) rows.push_back({at, sum_t / count, sum_r / count});
    }
    return rows;
  }
};

void expect_rows(const std::vector<KittiRow>& rows,
                 const std::vector<std::array<double, 3>>& expected) {
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].at, expected[i][0]);
    EXPECT_NEAR(rows[i].t_percent / 100, expected[i][1], 1e-12);
    EXPECT_NEAR(rows[i].r_deg_per_100m * std::numbers::pi / 18000, expected[i][2], 1e-12);
  }
}

TEST(KittiFigures, AreTheDevkitsForDrivesOfAnySpeedAndLength) {
  Random random = test::seeded_random(55);
  for (int drive = 0; drive < 20; ++drive) {
    const double step_m = random.uniform(0.2, 2.6);
    const Trajectory truth =
        test::winding_drive(static_cast<int>(random.uniform(60, 900)), step_m, false);
    const std::vector<FramePair> pairs =
        pairs_of(truth, test::drifting(truth, 0.02, 0.001, random));
    const std::vector<SegmentError> segments = segments_of(pairs);
    const KittiFigures figures = kitti_figures(segments);
    const Devkit devkit(pairs);
    ASSERT_EQ(segments.size(), devkit.first.size());
    for (std::size_t k = 0; k < segments.size(); ++k)
      EXPECT_NEAR(kitti_speed_m_per_s(segments[k]), devkit.speed[k], 1e-9);
    expect_rows(figures.by_length, devkit.rows(devkit.length, 100, 850, 100, 1));
    expect_rows(figures.by_speed, devkit.rows(devkit.speed, 2, 25, 2, 2));
  }
}

TEST(KittiFigures, ThePathHasEveryThirdFrame) {
  EXPECT_EQ(kitti_path_text(straight_drive(5, 2, 0)),
            "0.000000 0.000000 0.000000 0.000000\n0.000000 3.000000 0.000000 6.000000\n");
}

TEST(KittiFigures, ReproduceThePublishedRowOfOrbSlam2) {
  PLACEGRAPH_DATA_OR_SKIP(folder, "golden");
  const KittiFigures figures =
      kitti_figures(segments_of(pairs_of(read_trajectory(folder + "/KITTI_00_gt.txt"),
                                         read_trajectory(folder + "/KITTI_00_ORB.txt"))));
  EXPECT_NEAR(figures.t_rel_percent, 0.69973, 5e-6);
  EXPECT_NEAR(figures.r_rel_deg_per_100m, 0.25333, 5e-6);
  EXPECT_EQ(kitti_stats_text(figures), "0.006997 0.000044\n");
}

}  // namespace kitti_figures_test
}  // namespace placegraph
