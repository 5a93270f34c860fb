#include <gtest/gtest.h>
#include <placegraph/frontend/relative_pose/pose_2d2d.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace pose_2d2d_test {

using namespace test;
using Code = Outcome::Code;
const Camera kCamera = pinhole(640, 480, 500);
const SE3 kTruth = pose({0.03, -0.08, 0.02}, {0.6, -0.1, 0.5});  // T_ref_cur

/// Least sum of the rotation error and the error of the direction of translation [rad].
double nearest_rad(const std::vector<SE3>& motions, const SE3& truth) {
  double best = 10;
  for (const SE3& T : motions)
    best =
        std::min(best, angle_rad(T, truth) + angle_between(T.translation(), truth.translation()));
  return best;
}

TEST(Pose2d2d, ReadsAGeneralSceneByTheEssentialMatrix) {
  Random random = seeded_random(21);
  PointScene scene = make_scene(kCamera, {SE3(), kTruth}, 120, random);
  const auto exact = estimate_pose_2d2d(kCamera, scene.px[0], scene.px[1], {}, random);
  ASSERT_TRUE(exact.outcome) << exact.outcome.reason;
  EXPECT_EQ(exact.model, TwoViewModel::kEssential);
  EXPECT_EQ(exact.T_ref_cur.size(), 4u);
  EXPECT_EQ(exact.inliers.size(), 120u);
  for (const SE3& T : exact.T_ref_cur) EXPECT_NEAR(T.translation().norm(), 1, 1e-9);
  EXPECT_LT(nearest_rad(exact.T_ref_cur, kTruth), 1e-4);

  add_noise(scene.px[1], 0.3, random);
  const int outliers = spoil(kCamera, scene.px[1], 0, 4, random);
  const auto noisy = estimate_pose_2d2d(kCamera, scene.px[0], scene.px[1], {}, random);
  ASSERT_TRUE(noisy.outcome);
  EXPECT_EQ(noisy.model, TwoViewModel::kEssential);
  // The lines let some of the wrong matches through: one in a hundred by chance.
  EXPECT_LE(noisy.inliers.size(), 120u - static_cast<unsigned>(outliers) + 4u);
  EXPECT_LT(nearest_rad(noisy.T_ref_cur, kTruth), deg_to_rad(3));
}

TEST(Pose2d2d, ReadsAPlaneByTheHomography) {
  Random random = seeded_random(22);
  PointScene scene = make_scene(kCamera, {SE3(), kTruth}, 120, random, on_plane({0.2, 0.3, 1}, 6));
  const auto exact = estimate_pose_2d2d(kCamera, scene.px[0], scene.px[1], {}, random);
  ASSERT_TRUE(exact.outcome);
  EXPECT_EQ(exact.model, TwoViewModel::kHomography);
  EXPECT_GT(exact.homography_share, 0.45);
  EXPECT_LE(exact.T_ref_cur.size(), 2u);
  EXPECT_LT(nearest_rad(exact.T_ref_cur, kTruth), 1e-5);

  add_noise(scene.px[1], 0.3, random);
  const auto noisy = estimate_pose_2d2d(kCamera, scene.px[0], scene.px[1], {}, random);
  ASSERT_TRUE(noisy.outcome);
  EXPECT_EQ(noisy.model, TwoViewModel::kHomography);
  EXPECT_LT(nearest_rad(noisy.T_ref_cur, kTruth), deg_to_rad(3));
}

TEST(Pose2d2d, SaysWhenThereAreTooFewPointsOrNoConsensus) {
  Random random = seeded_random(23);
  PointScene scene = make_scene(kCamera, {SE3(), kTruth}, 29, random);
  EXPECT_EQ(estimate_pose_2d2d(kCamera, scene.px[0], scene.px[1], {}, random).outcome.code,
            Code::kTooFewData);
  scene = make_scene(kCamera, {SE3(), kTruth}, 100, random);
  spoil(kCamera, scene.px[1], 0, 1, random);
  EXPECT_EQ(estimate_pose_2d2d(kCamera, scene.px[0], scene.px[1], {}, random).outcome.code,
            Code::kNoConsensus);
  scene.px[1].pop_back();
  EXPECT_THROW((void)estimate_pose_2d2d(kCamera, scene.px[0], scene.px[1], {}, random),
               ArgumentError);
}

TEST(Pose2d2d, SaysThatACameraAtRestHasNoTranslation) {
  Random random = seeded_random(24);
  const PointScene scene = make_scene(kCamera, {SE3(), SE3()}, 100, random);
  EXPECT_EQ(estimate_pose_2d2d(kCamera, scene.px[0], scene.px[1], {}, random).outcome.code,
            Code::kDegenerate);
}

}  // namespace pose_2d2d_test
}  // namespace placegraph
