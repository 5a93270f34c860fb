#include <gtest/gtest.h>
#include <placegraph/frontend/relative_pose/pose_3d2d.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace pose_3d2d_test {

using namespace test;
using Code = Outcome::Code;
const Camera kCamera = pinhole(640, 480, 500);
const SE3 kTruth = pose({0.1, -0.2, 0.05}, {0.6, -0.3, 0.8});

TEST(Pose3d2d, IsExactWithoutNoise) {
  Random random = seeded_random(11);
  const PointScene scene = make_scene(kCamera, {kTruth}, 60, random);
  const auto result = estimate_pose_3d2d(kCamera, scene.points_ref, scene.px[0], {}, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_EQ(result.inliers.size(), 60u);
  EXPECT_LT(distance_m(result.T_ref_cam, kTruth), 1e-7);
  EXPECT_LT(angle_rad(result.T_ref_cam, kTruth), 1e-7);
  EXPECT_LT(result.rmse_px, 1e-4);
}

TEST(Pose3d2d, FindsThePoseAmongFortyPercentOutliers) {
  Random random = seeded_random(12);
  PointScene scene = make_scene(kCamera, {kTruth}, 150, random);
  add_noise(scene.px[0], 0.5, random);
  const int outliers =
      spoil(kCamera, scene.px[0], 0, 5, random) + spoil(kCamera, scene.px[0], 2, 5, random);
  const auto result = estimate_pose_3d2d(kCamera, scene.points_ref, scene.px[0], {}, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  // The threshold lies at five sigma of the noise.
  EXPECT_EQ(static_cast<int>(result.inliers.size()), 150 - outliers);
  for (const int i : result.inliers) EXPECT_TRUE(i % 5 != 0 && i % 5 != 2) << i;
  EXPECT_NEAR(result.rmse_px, 0.5, 4 * 0.5 / std::sqrt(2.0 * 2 * 90));
  const Vector6d error = (kTruth.inverse() * result.T_ref_cam).log();
  EXPECT_LT(error.dot(result.information * error), 22.5);  // chi2 of 6, 99.9 %
}

TEST(Pose3d2d, ClaimsACovarianceThatItsErrorsBearOut) {
  Random random = seeded_random(13);
  constexpr int kRuns = 80, kPoints = 80;
  double nees = 0;
  for (int run = 0; run < kRuns; ++run) {
    PointScene scene = make_scene(kCamera, {kTruth}, kPoints, random);
    add_noise(scene.px[0], 0.6, random);
    const auto result =
        estimate_pose_3d2d(kCamera, scene.points_ref, scene.px[0], {}, random, &kTruth);
    ASSERT_TRUE(result.outcome);
    const Vector6d error = (kTruth.inverse() * result.T_ref_cam).log();
    nees += error.dot(result.information * error) / kRuns;
  }
  // chi2 with 6 * 80 degrees of freedom over 80: 99.9 % lie within 6 +- 3.29 sqrt(12 / 80).
  EXPECT_GT(nees, 6 - 3.29 * std::sqrt(12.0 / kRuns));
  EXPECT_LT(nees, 6 + 3.29 * std::sqrt(12.0 / kRuns));
}

TEST(Pose3d2d, AgreesWithAndWithoutAPrior) {
  Random random = seeded_random(14);
  PointScene scene = make_scene(kCamera, {kTruth}, 120, random);
  add_noise(scene.px[0], 0.5, random);
  spoil(kCamera, scene.px[0], 0, 6, random);
  // The prediction is some 5 px off.
  const SE3 prior = kTruth * pose({0.01, -0.005, 0.01}, {0.03, -0.02, 0.03});
  const auto with = estimate_pose_3d2d(kCamera, scene.points_ref, scene.px[0], {}, random, &prior);
  const auto without = estimate_pose_3d2d(kCamera, scene.points_ref, scene.px[0], {}, random);
  ASSERT_TRUE(with.outcome);
  ASSERT_TRUE(without.outcome);
  EXPECT_EQ(with.inliers, without.inliers);
  EXPECT_LT(distance_m(with.T_ref_cam, without.T_ref_cam), 1e-5);
  EXPECT_LT(angle_rad(with.T_ref_cam, without.T_ref_cam), 1e-5);
}

TEST(Pose3d2d, IsNotMisledByAWrongPrior) {
  Random random = seeded_random(15);
  const PointScene scene = make_scene(kCamera, {kTruth}, 80, random);
  const SE3 prior = kTruth * pose({0, 1.2, 0}, {3, 0, -2});
  const auto result =
      estimate_pose_3d2d(kCamera, scene.points_ref, scene.px[0], {}, random, &prior);
  ASSERT_TRUE(result.outcome);
  EXPECT_LT(distance_m(result.T_ref_cam, kTruth), 1e-6);
}

TEST(Pose3d2d, WorksOnAPlane) {
  Random random = seeded_random(16);
  PointScene scene = make_scene(kCamera, {kTruth}, 100, random, on_plane({0.1, 0.3, 1}, 6));
  add_noise(scene.px[0], 0.3, random);
  const auto result = estimate_pose_3d2d(kCamera, scene.points_ref, scene.px[0], {}, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  const Vector6d error = (kTruth.inverse() * result.T_ref_cam).log();
  EXPECT_LT(error.dot(result.information * error), 22.5);
}

TEST(Pose3d2d, RefusesPointsOnALine) {
  Random random = seeded_random(17);
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> px;
  for (int i = 0; i < 40; ++i) {
    points.push_back(kTruth * Eigen::Vector3d(-2 + 0.1 * i, 0.5 - 0.02 * i, 6 + 0.05 * i));
    px.push_back(*kCamera.project(kTruth.inverse() * points.back()));
  }
  const auto with_prior = estimate_pose_3d2d(kCamera, points, px, {}, random, &kTruth);
  EXPECT_EQ(with_prior.outcome.code, Code::kDegenerate) << with_prior.outcome.reason;
  EXPECT_FALSE(estimate_pose_3d2d(kCamera, points, px, {}, random).outcome);
}

TEST(Pose3d2d, SaysWhenThereAreTooFewPointsOrNoConsensus) {
  Random random = seeded_random(18);
  PointScene scene = make_scene(kCamera, {kTruth}, 60, random);
  Pose3d2dOptions options;
  options.ransac.min_inliers = 61;
  EXPECT_EQ(
      estimate_pose_3d2d(kCamera, scene.points_ref, scene.px[0], options, random).outcome.code,
      Code::kTooFewData);
  spoil(kCamera, scene.px[0], 0, 1, random);
  const auto none = estimate_pose_3d2d(kCamera, scene.points_ref, scene.px[0], {}, random);
  EXPECT_EQ(none.outcome.code, Code::kNoConsensus);
  EXPECT_LT(none.inliers.size(), 12u);
  scene.px[0].pop_back();
  EXPECT_THROW((void)estimate_pose_3d2d(kCamera, scene.points_ref, scene.px[0], {}, random),
               ArgumentError);
}

}  // namespace pose_3d2d_test
}  // namespace placegraph
