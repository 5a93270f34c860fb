#include <gtest/gtest.h>
#include <placegraph/eval/plots/evaluation_series.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <numbers>

#include "tests/support/seed.h"

namespace placegraph {
namespace evaluation_series_test {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kRadian_deg = 180 / std::numbers::pi;

Isometry3d pose_of(double roll, double pitch, double yaw, const Vector3d& position) {
  Isometry3d T = Isometry3d::Identity();
  T.linear() = (AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(pitch, Vector3d::UnitY()) *
                AngleAxisd(roll, Vector3d::UnitX()))
                   .toRotationMatrix();
  T.translation() = position;
  return T;
}

/// An evaluation of these true poses, one every half second from `begin_s`, exact until changed.
EvaluationResult exact(const std::vector<Isometry3d>& truth, double begin_s = 0) {
  EvaluationResult result;
  result.outcome = Outcome::ok();
  result.name = "run.kitti";
  result.has_times = true;
  double travelled = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (i > 0) travelled += (truth[i].translation() - truth[i - 1].translation()).norm();
    const double time_s = begin_s + 0.5 * static_cast<double>(i);
    result.aligned_pairs.push_back(
        {static_cast<int>(i), static_cast<std::int64_t>(time_s * 1e9), truth[i], truth[i]});
    result.travelled_m.push_back(travelled);
  }
  return result;
}

std::vector<Isometry3d> random_walk(Random& random, int poses) {
  std::vector<Isometry3d> walk;
  for (int i = 0; i < poses; ++i)
    walk.push_back(pose_of(random.uniform(-3, 3), random.uniform(-1.5, 1.5), random.uniform(-3, 3),
                           {random.normal(), random.normal(), random.normal()}));
  return walk;
}

/// The points of a line of a panel.
const std::vector<std::optional<Eigen::Vector2d>>& line(const Figure& figure, std::size_t panel,
                                                        std::size_t shape) {
  return std::get<FigureLine>(figure.panels.at(panel).shapes.at(shape)).points;
}

TEST(EvaluationSeries, CoordinatesAreThoseOfThePosesOverTime) {
  Random random = test::seeded_random(11);
  const std::vector<Isometry3d> truth = random_walk(random, 20);
  EvaluationResult early = exact(truth), late = exact({truth.begin(), truth.begin() + 15}, 3);
  late.aligned_pairs[4].T_world_estimate.reset();
  Figure figure;
  draw_coordinates({late, early}, figure);
  ASSERT_EQ(figure.panels.size(), 3u);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ASSERT_EQ(line(figure, axis, 0).size(), 20u);  // the longer truth is drawn
    EXPECT_FALSE(line(figure, axis, 1)[4]);
    for (std::size_t i = 0; i < 15; ++i) {
      const double expected = truth[i].translation()[static_cast<int>(axis)];
      if (i != 4) {
        EXPECT_EQ((*line(figure, axis, 1)[i])[1], expected);
        EXPECT_NEAR((*line(figure, axis, 1)[i])[0], 3 + 0.5 * static_cast<double>(i), 1e-9);
      }
      EXPECT_EQ(*line(figure, axis, 2)[i], *line(figure, axis, 0)[i]);
    }
  }
  EXPECT_EQ(figure.legend.at(1).text, "run");
}

TEST(EvaluationSeries, AnglesComposeTheRotation) {
  Random random = test::seeded_random(12);
  const std::vector<Isometry3d> truth = random_walk(random, 40);
  Figure figure;
  draw_angles({exact(truth)}, figure);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    Vector3d angles;
    for (std::size_t row = 0; row < 3; ++row)
      angles[static_cast<int>(row)] = (*line(figure, row, 1)[i])[1] / kRadian_deg;
    const Isometry3d T = pose_of(angles[0], angles[1], angles[2], Vector3d::Zero());
    EXPECT_LT((T.linear() - truth[i].linear()).norm(), 1e-9);
  }
}

TEST(EvaluationSeries, AnglesGoOnBeyond360Degrees) {
  std::vector<Isometry3d> rotations;
  for (int i = 0; i <= 36; ++i) rotations.push_back(pose_of(0, 0, i * 30 / kRadian_deg, {0, 0, 0}));
  EvaluationResult result = exact(rotations);
  for (FramePair& pair : result.aligned_pairs)
    pair.T_world_estimate->linear() =
        AngleAxisd(25 / kRadian_deg, Vector3d::UnitZ()).toRotationMatrix() *
        pair.T_world_estimate->linear();
  Figure figure;
  draw_angles({result}, figure);
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    EXPECT_NEAR((*line(figure, 2, 0)[i])[1], 30.0 * static_cast<double>(i), 1e-9);
    EXPECT_NEAR((*line(figure, 2, 1)[i])[1], 30.0 * static_cast<double>(i) + 25, 1e-9);
  }
}

TEST(EvaluationSeries, RelativeErrorsDoNotDependOnTheFrameOfTheEstimate) {
  Random random = test::seeded_random(13);
  const std::vector<Isometry3d> truth = random_walk(random, 12);
  EvaluationResult result = exact(truth);
  const Isometry3d T_other_world = pose_of(1, 0.5, -2, {4, 5, 6});
  for (FramePair& pair : result.aligned_pairs)
    pair.T_world_estimate = T_other_world * *pair.T_world_estimate;
  Figure figure;
  draw_relative_errors({result}, figure);
  for (std::size_t panel = 0; panel < 2; ++panel) {
    ASSERT_EQ(line(figure, panel, 0).size(), 11u);
    // An angle is the arc cosine of its trace: 1e-16 of that are 1e-8 rad.
    for (const auto& p : line(figure, panel, 0)) EXPECT_LT((*p)[1], panel == 0 ? 1e-12 : 1e-5);
  }
}

TEST(EvaluationSeries, RelativeErrorsAreThoseOfOneStepAndMissBesideALostFrame) {
  std::vector<Isometry3d> truth;
  for (int i = 0; i < 9; ++i) truth.push_back(pose_of(0, 0, 0, {2.0 * i, 0, 0}));
  EvaluationResult result = exact(truth);
  for (int i = 0; i < 9; ++i)  // too long by 0.3 m and turned by 0.02 rad, every step
    result.aligned_pairs[static_cast<std::size_t>(i)].T_world_estimate =
        pose_of(0.02 * i, 0, 0, {2.3 * i, 0, 0});
  result.aligned_pairs[5].T_world_estimate.reset();
  Figure figure;
  draw_relative_errors({result}, figure);
  for (std::size_t i = 0; i < 8; ++i) {
    const auto &shift = line(figure, 0, 0)[i], &rotation = line(figure, 1, 0)[i];
    ASSERT_EQ(shift.has_value(), i != 4 && i != 5);
    if (!shift) continue;
    EXPECT_NEAR((*shift)[0], 2.0 * static_cast<double>(i + 1), 1e-12);
    EXPECT_NEAR((*shift)[1], 0.3, 1e-12);
    EXPECT_NEAR((*rotation)[1], 0.02 * kRadian_deg, 1e-9);
  }
}

TEST(EvaluationSeries, NamesLoseOnlyTheEndingOfATrajectory) {
  EXPECT_EQ(plot_name("a.txt"), "a");
  EXPECT_EQ(plot_name("a.b.tum"), "a.b");
  EXPECT_EQ(plot_name("a.json"), "a.json");
  EXPECT_EQ(plot_name(".csv"), ".csv");
}

}  // namespace evaluation_series_test
}  // namespace placegraph
