#include <gtest/gtest.h>
#include <placegraph/frontend/relative_pose/relative_pose.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace pose_gravity_test {

using namespace test;
using Code = Outcome::Code;
const Camera kCamera = pinhole(640, 480, 500);
const SE3 kTruth = pose({0.03, -0.28, 0.02}, {0.6, -0.1, 0.5});  // T_ref_cur
const Eigen::Vector3d kDownRef = Eigen::Vector3d(0.1, 1, -0.2).normalized();
const Eigen::Vector3d kDownCur = kTruth.rotation().inverse() * kDownRef;

GravityPoseResult estimate(const PointScene& scene, Random& random,
                           const Eigen::Vector3d& down_cur = kDownCur,
                           const GravityPoseOptions& options = {}) {
  return estimate_pose_with_gravity(kCamera, scene.px[0], scene.px[1], kDownRef, down_cur, options,
                                    random);
}

TEST(PoseWithGravity, IsExactWithoutNoise) {
  Random random = seeded_random(31);
  const PointScene scene = make_scene(kCamera, {SE3(), kTruth}, 60, random);
  const auto result = estimate(scene, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_EQ(result.inliers.size(), 60u);
  EXPECT_LT(angle_rad(result.T_ref_cur, kTruth), 1e-7);
  EXPECT_LT(angle_between(result.T_ref_cur.translation(), kTruth.translation()), 1e-7);
  EXPECT_NEAR(result.T_ref_cur.translation().norm(), 1, 1e-12);
  EXPECT_LT(result.rmse_px, 1e-5);
}

TEST(PoseWithGravity, FindsTheMotionOverAPlaneWhereTheEssentialMatrixIsDegenerate) {
  Random random = seeded_random(32);
  const PointScene scene =
      make_scene(kCamera, {SE3(), kTruth}, 80, random, on_plane({0.2, 0.3, 1}, 6));
  const auto result = estimate(scene, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_LT(angle_rad(result.T_ref_cur, kTruth), 1e-6);
  EXPECT_LT(angle_between(result.T_ref_cur.translation(), kTruth.translation()), 1e-6);
}

TEST(PoseWithGravity, FindsTheMotionAmongHalfOutliers) {
  Random random = seeded_random(33);
  PointScene scene = make_scene(kCamera, {SE3(), kTruth}, 160, random);
  add_noise(scene.px[0], 0.3, random);
  add_noise(scene.px[1], 0.3, random);
  const int outliers = spoil(kCamera, scene.px[1], 0, 2, random);
  const auto result = estimate(scene, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  // One wrong match in a hundred lies near its epipolar line by chance.
  EXPECT_LE(static_cast<int>(result.inliers.size()), 160 - outliers + 5);
  const SE3 truth(kTruth.rotation(), kTruth.translation().normalized());
  const Vector6d error = (truth.inverse() * result.T_ref_cur).log();
  EXPECT_LT(error.dot(result.information * error), 25);  // chi2 of 5, 99.99 %
  EXPECT_LT(angle_rad(result.T_ref_cur, kTruth), 0.01);
}

TEST(PoseWithGravity, CorrectsAVerticalThatIsSlightlyOff) {
  Random random = seeded_random(34);
  const PointScene scene = make_scene(kCamera, {SE3(), kTruth}, 200, random);
  const double off_rad = deg_to_rad(0.2);
  const Eigen::Vector3d tilted = SO3::exp(off_rad * kDownCur.unitOrthogonal()) * kDownCur;
  GravityPoseOptions options;
  options.threshold_px = 3;
  const auto result = estimate(scene, random, tilted, options);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  // Points without noise outweigh a vertical known to 0.3 deg.
  EXPECT_LT(angle_rad(result.T_ref_cur, kTruth), 0.2 * off_rad);
}

TEST(PoseWithGravity, KnowsNothingOfTheLength) {
  Random random = seeded_random(35);
  const PointScene scene = make_scene(kCamera, {SE3(), kTruth}, 60, random);
  const auto result = estimate(scene, random);
  ASSERT_TRUE(result.outcome);
  Vector6d along;
  along << result.T_ref_cur.rotation().inverse() * result.T_ref_cur.translation(),
      Eigen::Vector3d::Zero();
  EXPECT_LT(along.dot(result.information * along), 1e-6 * result.information.trace());
}

TEST(PoseWithGravity, SaysThatAPureRotationHasNoTranslation) {
  Random random = seeded_random(36);
  const SE3 pure_rotation = pose({0, 0.1, 0}, {0, 0, 0});
  PointScene scene = make_scene(kCamera, {SE3(), pure_rotation}, 60, random);
  add_noise(scene.px[1], 0.2, random);
  const auto result =
      estimate_pose_with_gravity(kCamera, scene.px[0], scene.px[1], Eigen::Vector3d::UnitY(),
                                 Eigen::Vector3d::UnitY(), {}, random);
  EXPECT_EQ(result.outcome.code, Code::kDegenerate);
  EXPECT_LT(result.parallax_px, 1);
}

TEST(PoseWithGravity, RefusesWhatCannotBe) {
  Random random = seeded_random(37);
  const PointScene scene = make_scene(kCamera, {SE3(), kTruth}, 10, random);
  EXPECT_EQ(estimate(scene, random).outcome.code, Code::kTooFewData);
  PointScene wild = make_scene(kCamera, {SE3(), kTruth}, 60, random);
  spoil(kCamera, wild.px[1], 0, 1, random);
  EXPECT_EQ(estimate(wild, random).outcome.code, Code::kNoConsensus);
  EXPECT_THROW((void)estimate(scene, random, 2 * kDownCur), ArgumentError);
  EXPECT_THROW(
      (void)estimate_pose_with_gravity(kCamera, scene.px[0], {}, kDownRef, kDownCur, {}, random),
      ArgumentError);
}

}  // namespace pose_gravity_test
}  // namespace placegraph
