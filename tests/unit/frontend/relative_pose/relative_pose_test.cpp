#include <gtest/gtest.h>
#include <placegraph/frontend/relative_pose/relative_pose.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace relative_pose_test {

using namespace test;
using Code = Outcome::Code;
using Model = RelativePoseModel;
const Camera kCamera = pinhole(640, 480, 500);
const SE3 kTruth = pose({0.03, -0.08, 0.02}, {0.6, -0.1, 0.5});  // T_ref_cur

/// Of the pose in units of its claimed covariance, five degrees of freedom.
double nees(const RelativePose& found, const SE3& truth) {
  const SE3 unit(truth.rotation(), truth.translation().normalized());
  const Vector6d error = (unit.inverse() * *found.T_ref_cur).log();
  return error.dot(found.covariance.completeOrthogonalDecomposition().pseudoInverse() * error);
}

TEST(RelativePoseOfTwoViews, IsThatOfTheEssentialMatrixInAGeneralScene) {
  Random random = seeded_random(41);
  PointScene scene = make_scene(kCamera, {SE3(), kTruth}, 150, random);
  for (auto& px : scene.px) add_noise(px, 0.3, random);
  const int spoilt = spoil(kCamera, scene.px[1], 0, 4, random);
  const RelativePose found = estimate_relative_pose(kCamera, scene.px[0], scene.px[1], {}, random);
  ASSERT_TRUE(found.outcome) << found.outcome.reason;
  EXPECT_EQ(found.model, Model::kEssential);
  EXPECT_TRUE(found.rivals.empty());
  EXPECT_GE(found.inliers.size(), 140u - static_cast<unsigned>(spoilt));
  EXPECT_NEAR(found.T_ref_cur->translation().norm(), 1, 1e-9);
  // 99.9 % of chi2 with five degrees of freedom, and the outliers that lie on their lines.
  EXPECT_LT(nees(found, kTruth), 20.5 * 1.5);
  EXPECT_GT(found.parallax_px, 5);
}

TEST(RelativePoseOfTwoViews, KnowsHowWellItKnows) {
  Random random = seeded_random(42);
  constexpr int kRuns = 40;
  double sum = 0;
  for (int run = 0; run < kRuns; ++run) {
    PointScene scene = make_scene(kCamera, {SE3(), kTruth}, 100, random);
    for (auto& px : scene.px) add_noise(px, 0.3, random);
    RelativePoseOptions options;
    options.two_view.threshold_px = 2;
    options.model = Model::kEssential;
    const RelativePose found =
        estimate_relative_pose(kCamera, scene.px[0], scene.px[1], options, random);
    ASSERT_TRUE(found.outcome) << run << ": " << found.outcome.reason;
    sum += nees(found, kTruth) / (5.0 * kRuns);
  }
  // Mean of 200 degrees of freedom: a deviation of a tenth, four of them.
  EXPECT_GT(sum, 0.6);
  EXPECT_LT(sum, 1.4);
}

TEST(RelativePoseOfTwoViews, HasTwoReadingsBeforeOnePlane) {
  Random random = seeded_random(43);
  PointScene scene = make_scene(kCamera, {SE3(), kTruth}, 120, random, on_plane({0.2, 0.3, 1}, 6));
  for (auto& px : scene.px) add_noise(px, 0.2, random);
  const RelativePose found = estimate_relative_pose(kCamera, scene.px[0], scene.px[1], {}, random);
  EXPECT_EQ(found.model, Model::kHomography);
  ASSERT_TRUE(found.T_ref_cur) << found.outcome.reason;
  double nearest = 1;
  const std::vector<SE3> readings =
      found.rivals.empty() ? std::vector<SE3>{*found.T_ref_cur} : found.rivals;
  for (const SE3& T : readings)
    nearest = std::min(nearest,
                       angle_rad(T, kTruth) + angle_between(T.translation(), kTruth.translation()));
  EXPECT_LT(nearest, deg_to_rad(2));
  // Matches before both cameras leave one or two.
  EXPECT_EQ(found.outcome.code, found.rivals.empty() ? Code::kOk : Code::kInconsistent);
  EXPECT_EQ(found.covariance, found.covariance.transpose().eval());
}

TEST(RelativePoseOfTwoViews, IsARotationWhereThereIsNoWay) {
  Random random = seeded_random(44);
  const SE3 pure_rotation = pose({0.02, 0.1, -0.03}, {0, 0, 0});
  PointScene scene = make_scene(kCamera, {SE3(), pure_rotation}, 120, random);
  for (auto& px : scene.px) add_noise(px, 0.2, random);
  spoil(kCamera, scene.px[1], 0, 4, random);
  const RelativePose found = estimate_relative_pose(kCamera, scene.px[0], scene.px[1], {}, random);
  ASSERT_TRUE(found.outcome) << found.outcome.reason;
  EXPECT_EQ(found.model, Model::kRotation);
  EXPECT_FALSE(found.T_ref_cur);
  // 90 points of 0.28 px at 500 px: hundredths of a degree.
  EXPECT_LT((found.R_ref_cur->inverse() * pure_rotation.rotation()).log().norm(), deg_to_rad(0.05));
  EXPECT_GT(found.covariance(3, 3), 0);

  RelativePoseOptions options;
  options.model = Model::kEssential;
  const RelativePose asked =
      estimate_relative_pose(kCamera, scene.px[0], scene.px[1], options, random);
  EXPECT_FALSE(asked.outcome);
}

TEST(RelativePoseOfTwoViews, SaysWhyThereIsNone) {
  Random random = seeded_random(45);
  PointScene scene = make_scene(kCamera, {SE3(), kTruth}, 20, random);
  EXPECT_EQ(estimate_relative_pose(kCamera, scene.px[0], scene.px[1], {}, random).outcome.code,
            Code::kTooFewData);
  scene = make_scene(kCamera, {SE3(), kTruth}, 100, random);
  RelativePoseOptions options;
  options.model = Model::kRotation;
  const auto rotated = estimate_relative_pose(kCamera, scene.px[0], scene.px[1], options, random);
  EXPECT_FALSE(rotated.outcome);
  EXPECT_FALSE(rotated.R_ref_cur);
  for (auto& px : scene.px[1])
    px = {random.uniform(0, kCamera.width), random.uniform(0, kCamera.height)};
  EXPECT_EQ(estimate_relative_pose(kCamera, scene.px[0], scene.px[1], {}, random).outcome.code,
            Code::kNoConsensus);
  scene.px[1].pop_back();
  EXPECT_THROW((void)estimate_relative_pose(kCamera, scene.px[0], scene.px[1], {}, random),
               ArgumentError);
}

}  // namespace relative_pose_test
}  // namespace placegraph
