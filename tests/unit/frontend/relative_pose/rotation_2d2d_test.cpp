#include <gtest/gtest.h>
#include <placegraph/frontend/relative_pose/rotation_2d2d.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace rotation_2d2d_test {

using namespace test;
using Code = Outcome::Code;
const Camera kCamera = pinhole(640, 480, 500);
const SE3 kRotation = pose({0.05, -0.2, 0.03}, {0, 0, 0});  // T_ref_cur

double error_rad(const SO3& R, const SE3& truth) {
  return (R.inverse() * truth.rotation()).log().norm();
}

TEST(Rotation2d2d, IsExactWhereTheViewsShareTheirCentre) {
  Random random = seeded_random(51);
  const PointScene scene = make_scene(kCamera, {SE3(), kRotation}, 80, random);
  const auto result = estimate_rotation_2d2d(kCamera, scene.px[0], scene.px[1], {}, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_LT(error_rad(result.R_ref_cur, kRotation), 1e-9);
  EXPECT_EQ(result.inliers.size(), 80u);
  EXPECT_LT(result.rmse_px, 1e-6);
}

TEST(Rotation2d2d, ErrsByNoMoreThanItSaysWithNoiseAndWrongMatches) {
  Random random = seeded_random(52);
  double nees = 0;
  constexpr int kTrials = 100;
  for (int trial = 0; trial < kTrials; ++trial) {
    PointScene scene = make_scene(kCamera, {SE3(), kRotation}, 80, random);
    add_noise(scene.px[1], 0.4, random);
    spoil(kCamera, scene.px[1], 0, 10, random);
    const auto result = estimate_rotation_2d2d(kCamera, scene.px[0], scene.px[1], {}, random);
    ASSERT_TRUE(result.outcome) << result.outcome.reason;
    const Eigen::Vector3d e = (result.R_ref_cur.inverse() * kRotation.rotation()).log();
    nees += e.dot(result.covariance.ldlt().solve(e)) / (3 * kTrials);
  }
  EXPECT_LT(nees, 1.5);
  EXPECT_GT(nees, 0.02);  // room for way that the threshold lets pass
}

TEST(Rotation2d2d, RefusesViewsBetweenWhichWayWasMade) {
  Random random = seeded_random(53);
  const PointScene scene =
      make_scene(kCamera, {SE3(), kRotation * pose({0, 0, 0}, {0.4, 0, 0.1})}, 80, random);
  const auto result = estimate_rotation_2d2d(kCamera, scene.px[0], scene.px[1], {}, random);
  EXPECT_FALSE(result.outcome);
  Rotation2d2dOptions few;
  few.ransac.min_inliers = 3;
  const auto lenient = estimate_rotation_2d2d(kCamera, scene.px[0], scene.px[1], few, random);
  EXPECT_EQ(lenient.outcome.code, Code::kInconsistent);
}

TEST(Rotation2d2d, SaysNothingOfPointsThatLieInOneDirection) {
  Random random = seeded_random(55);
  const std::vector<Eigen::Vector2d> px(40, Eigen::Vector2d(320, 240));
  EXPECT_EQ(estimate_rotation_2d2d(kCamera, px, px, {}, random).outcome.code, Code::kDegenerate);
}

TEST(Rotation2d2d, RefusesTooFewPointsAndListsOfUnequalLength) {
  Random random = seeded_random(54);
  const PointScene scene = make_scene(kCamera, {SE3(), kRotation}, 10, random);
  EXPECT_EQ(estimate_rotation_2d2d(kCamera, scene.px[0], scene.px[1], {}, random).outcome.code,
            Code::kTooFewData);
  std::vector<Eigen::Vector2d> shorter = scene.px[1];
  shorter.pop_back();
  EXPECT_THROW((void)estimate_rotation_2d2d(kCamera, scene.px[0], shorter, {}, random),
               ArgumentError);
}

}  // namespace rotation_2d2d_test
}  // namespace placegraph
