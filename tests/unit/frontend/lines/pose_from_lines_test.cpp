#include <gtest/gtest.h>
#include <placegraph/frontend/lines/pose_from_lines.h>
#include <placegraph/graph/core/angle.h>

#include "tests/support/scenes/line_scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace pose_from_lines_test {

using namespace test;
using Code = Outcome::Code;
const SE3 kTruth = pose({0.05, -0.1, 0.03}, {0.4, -0.2, 0.5});

std::vector<SeenLine> observations(const LineScene& scene, const SE3& T_ref_cam, double noise_px,
                                   Random& random) {
  std::vector<SeenLine> lines;
  for (std::size_t i = 0; i < scene.from.size(); ++i)
    if (const auto seen = scene.seen(i, T_ref_cam, noise_px, random))
      lines.push_back({scene.line(i), *seen});
  return lines;
}

TEST(TriangulateLine, IsExactWithoutNoiseAndReportsItsRotation) {
  Random random = seeded_random(20);
  const LineScene scene = random_lines(20, random);
  int known = 0;
  for (std::size_t i = 0; i < scene.from.size(); ++i) {
    const auto a = scene.seen(i, SE3(), 0, random), b = scene.seen(i, kTruth, 0, random);
    if (!a || !b) continue;
    const auto line = triangulate_line(scene.camera, {{SE3(), *a}, {kTruth, *b}}, {});
    if (!line.outcome) continue;
    ++known;
    EXPECT_NEAR(std::abs(line.line_ref.direction().dot(scene.line(i).direction())), 1, 1e-6);
    EXPECT_LT(line.line_ref.distance_to(scene.from[i]), 1e-3);
    EXPECT_GE(line.rotation_rad, deg_to_rad(1.5));
  }
  EXPECT_GT(known, 5);
}

TEST(TriangulateLine, RefusesALineAlongTheEpipolarPlane) {
  LineScene scene;
  scene.from = {{-1, 0.5, 5}};
  scene.to = {{1, 0.5, 5}};
  Random random(1);
  const SE3 aside(SO3(), Eigen::Vector3d(0.5, 0, 0));
  const auto result = triangulate_line(
      scene.camera,
      {{SE3(), *scene.seen(0, SE3(), 0.1, random)}, {aside, *scene.seen(0, aside, 0.1, random)}},
      {});
  EXPECT_EQ(result.outcome.code, Code::kDegenerate);
  const SE3 above(SO3(), Eigen::Vector3d(0, -0.5, 0));
  EXPECT_TRUE(triangulate_line(scene.camera,
                               {{SE3(), *scene.seen(0, SE3(), 0.1, random)},
                                {above, *scene.seen(0, above, 0.1, random)}},
                               {})
                  .outcome);
}

TEST(TriangulateLine, RefusesTooFewAndContradictingObservations) {
  LineScene scene;
  scene.from = {{0, -1, 5}};
  scene.to = {{0.2, 1, 5}};
  Random random(2);
  const auto at = [&](double x) {
    const SE3 T(SO3(), Eigen::Vector3d(x, 0, 0));
    return LineMeasurement{T, *scene.seen(0, T, 0.1, random)};
  };
  EXPECT_EQ(triangulate_line(scene.camera, {at(0)}, {}).outcome.code, Code::kTooFewData);
  EXPECT_TRUE(triangulate_line(scene.camera, {at(0), at(0.3), at(0.6)}, {}).outcome);
  LineMeasurement wrong = at(0.3);
  wrong.seen.first.x() += 5;
  EXPECT_EQ(triangulate_line(scene.camera, {at(0), wrong, at(0.6)}, {}).outcome.code,
            Code::kInconsistent);
  LineMeasurement swapped = at(0);  // the eyes exchanged: the line would lie behind them
  swapped.T_ref_cam = at(0.6).T_ref_cam;
  LineMeasurement other = at(0.6);
  other.T_ref_cam = SE3();
  EXPECT_EQ(triangulate_line(scene.camera, {swapped, other}, {}).outcome.code, Code::kInconsistent);
}

TEST(SolveThreeLines, FindsTheTruePoseAmongItsSolutions) {
  Random random = seeded_random(21);
  int found = 0;
  constexpr int kRuns = 50;
  for (int run = 0; run < kRuns; ++run) {
    const LineScene scene = random_lines(3, random);
    const SE3 T_cam_ref = kTruth.inverse();
    std::array<Line3, 3> lines;
    std::array<Eigen::Vector3d, 3> normals;
    for (int i = 0; i < 3; ++i) {
      lines[i] = scene.line(i);
      normals[i] = transform_to(kTruth, lines[i]).head<3>().normalized();
    }
    const auto poses = solve_three_lines(lines, normals);
    EXPECT_LE(poses.size(), 8u);
    bool near = false;
    for (const SE3& T : poses) {
      for (int i = 0; i < 3; ++i)  // every solution sees the lines where they are
        EXPECT_NEAR(normals[i].dot(T.rotation() * lines[i].direction()), 0, 1e-4);
      near |= (T_cam_ref.inverse() * T).log().norm() < 1e-4;
    }
    found += near;
  }
  EXPECT_GE(found, kRuns - 1);  // but for one all but degenerate triple
}

TEST(PoseFromLines, IsExactWithoutNoiseAndWithoutAGuess) {
  Random random = seeded_random(22);
  const auto lines = observations(random_lines(25, random), kTruth, 0, random);
  const auto result = estimate_pose_from_lines(pinhole(640, 480, 500), lines, {}, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_LT((kTruth.inverse() * result.T_ref_cam).log().norm(), 1e-5);
}

TEST(PoseFromLines, FindsThePoseAmongFortyPercentOutliers) {
  Random random = seeded_random(23);
  auto lines = observations(random_lines(60, random), kTruth, 0.3, random);
  int outliers = 0;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (i % 5 < 2) {
      lines[i].seen.first += Eigen::Vector2d(random.uniform(15, 60), random.uniform(15, 60));
      lines[i].seen.second -= Eigen::Vector2d(random.uniform(15, 60), random.uniform(-60, -15));
      ++outliers;
    }
  const auto result = estimate_pose_from_lines(pinhole(640, 480, 500), lines, {}, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_LE(result.inliers.size(), lines.size() - outliers + 2);
  const Vector6d error = (kTruth.inverse() * result.T_ref_cam).log();
  EXPECT_LT(error.dot(result.information * error), 22.5);  // chi2 of 6, 99.9 %
}

TEST(PoseFromLines, ClaimsACovarianceThatItsErrorsBearOut) {
  Random random = seeded_random(24);
  constexpr int kRuns = 40;
  double nees = 0;
  for (int run = 0; run < kRuns; ++run) {
    const auto lines = observations(random_lines(40, random), kTruth, 0.4, random);
    const PoseGuess guess{kTruth};
    const auto result = estimate_pose_from_lines(pinhole(640, 480, 500), lines, {}, random, &guess);
    ASSERT_TRUE(result.outcome);
    const Vector6d error = (kTruth.inverse() * result.T_ref_cam).log();
    nees += error.dot(result.information * error) / (6.0 * kRuns);
  }
  EXPECT_GT(nees, 0.5);
  EXPECT_LT(nees, 2);
}

TEST(PoseFromLines, OfLinesOfOneDirectionLeavesTheWayAlongThemOpen) {
  Random random = seeded_random(25);
  LineScene scene;
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector3d p(random.uniform(-2, 2), 0, random.uniform(4, 8));
    scene.from.push_back(p - Eigen::Vector3d::UnitY());
    scene.to.push_back(p + Eigen::Vector3d::UnitY());
  }
  const auto lines = observations(scene, SE3(), 0.3, random);
  PoseGuess guess;
  EXPECT_EQ(estimate_pose_from_lines(scene.camera, lines, {}, random, &guess).outcome.code,
            Code::kDegenerate);
  guess.information = 1e2 * Matrix6d::Identity();  // a motion model fills the gap, and says so
  const auto held = estimate_pose_from_lines(scene.camera, lines, {}, random, &guess);
  ASSERT_TRUE(held.outcome) << held.outcome.reason;
  EXPECT_LT(held.information(1, 1), 200) << "nothing but the model";
  EXPECT_GT(held.information(0, 0), 1e4);
}

TEST(PoseFromLines, RefusesTooFewLinesAndLinesThatAgreeOnNothing) {
  Random random = seeded_random(26);
  auto lines = observations(random_lines(30, random), kTruth, 0, random);
  for (SeenLine& line : lines) {
    line.seen.first = {random.uniform(0, 639), random.uniform(0, 479)};
    line.seen.second = {random.uniform(0, 639), random.uniform(0, 479)};
  }
  EXPECT_EQ(estimate_pose_from_lines(pinhole(640, 480, 500), lines, {}, random).outcome.code,
            Code::kNoConsensus);
  lines.resize(4);
  EXPECT_EQ(estimate_pose_from_lines(pinhole(640, 480, 500), lines, {}, random).outcome.code,
            Code::kTooFewData);
}

}  // namespace pose_from_lines_test
}  // namespace placegraph
