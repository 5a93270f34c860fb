#include <gtest/gtest.h>
#include <placegraph/frontend/relative_pose/mono_initializer.h>
#include <placegraph/graph/core/angle.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace mono_initializer_test {

using namespace test;
using Code = Outcome::Code;
const Camera kCamera = pinhole(640, 480, 500);

/// Views at equal steps of the motion, the reference first, the current one last; those in between
/// swerve aside by up to `swerve_m`.
std::vector<SE3> path(const SE3& T_ref_cur, int steps, double swerve_m = 0) {
  std::vector<SE3> views;
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    views.push_back(SE3::exp(share * T_ref_cur.log()) *
                    pose({0, 0, 0}, {-swerve_m * std::sin(std::numbers::pi * share), 0, 0}));
  }
  return views;
}

std::vector<PartialView> views_between(const PointScene& scene) {
  std::vector<PartialView> between;
  for (std::size_t view = 1; view + 1 < scene.px.size(); ++view) {
    between.emplace_back();
    for (std::size_t i = 0; i < scene.px[view].size(); ++i)
      between.back().emplace_back(static_cast<int>(i), scene.px[view][i]);
  }
  return between;
}

MonoInitialization initialize(const PointScene& scene, bool with_between, Random& random) {
  return initialize_mono(kCamera, scene.px.front(), scene.px.back(),
                         with_between ? views_between(scene) : std::vector<PartialView>{}, {},
                         random);
}

TEST(MonoInitializer, FindsMotionAndStructureOfAGeneralScene) {
  Random random = seeded_random(31);
  const SE3 truth = pose({0.02, -0.05, 0.01}, {0.8, -0.1, 0.6});
  PointScene scene = make_scene(kCamera, {SE3(), truth}, 150, random);
  const auto result = initialize(scene, false, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_EQ(result.model, TwoViewModel::kEssential);
  EXPECT_LT(angle_rad(result.T_ref_cur, truth), 1e-4);
  EXPECT_NEAR(result.T_ref_cur.translation().norm(), 1, 1e-9);
  EXPECT_LT(angle_between(result.T_ref_cur.translation(), truth.translation()), 1e-4);
  EXPECT_EQ(result.triangulated, 150);
  EXPECT_GT(result.median_parallax_deg, 1);
  ASSERT_EQ(result.points_ref.size(), 150u);
  const double scale = truth.translation().norm();
  for (std::size_t i = 0; i < 150; ++i)
    EXPECT_LT((scale * *result.points_ref[i] - scene.points_ref[i]).norm(),
              0.01 * scene.points_ref[i].norm());
}

// A motion towards a plane at which its normal roughly points: both readings of the homography have
// all points in front.
const SE3 kTowards = pose({0.01, 0.03, 0.01}, {0.9, 0.3, 1.6});
const Eigen::Vector3d kNormal(0.25, -0.15, 1);

TEST(MonoInitializer, RefusesAPlaneWithTwoReadings) {
  Random random = seeded_random(32);
  PointScene scene = make_scene(kCamera, {SE3(), kTowards}, 150, random, on_plane(kNormal, 7));
  add_noise(scene.px.back(), 0.1, random);
  const auto result = initialize(scene, false, random);
  EXPECT_EQ(result.model, TwoViewModel::kHomography);
  EXPECT_EQ(result.candidates, 2);
  EXPECT_EQ(result.outcome.code, Code::kInconsistent) << result.outcome.reason;
}

TEST(MonoInitializer, ReadsAPlaneWithTheHelpOfViewsInBetween) {
  Random random = seeded_random(33);
  PointScene scene = make_scene(kCamera, path(kTowards, 5, 0.5), 150, random, on_plane(kNormal, 7));
  for (auto& px : scene.px) add_noise(px, 0.1, random);
  const auto result = initialize(scene, true, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_EQ(result.model, TwoViewModel::kHomography);
  EXPECT_LT(angle_rad(result.T_ref_cur, kTowards), deg_to_rad(1));
  EXPECT_LT(angle_between(result.T_ref_cur.translation(), kTowards.translation()), deg_to_rad(2));
}

TEST(MonoInitializer, SaysNothingForPureRotation) {
  for (const double noise_px : {0.0, 0.3}) {
    Random random = seeded_random(34);
    PointScene scene =
        make_scene(kCamera, path(pose({0.02, 0.15, 0.01}, {0, 0, 0}), 3), 150, random);
    for (auto& px : scene.px) add_noise(px, noise_px, random);
    const auto result = initialize(scene, true, random);
    EXPECT_FALSE(result.outcome) << noise_px;
    EXPECT_FALSE(result.outcome.reason.empty());
  }
}

TEST(MonoInitializer, SaysThatParallaxIsTooSmall) {
  Random random = seeded_random(35);
  // 5 cm at 4 to 15 m: at most 0.7 degrees, for few points more than 0.6.
  const PointScene scene =
      make_scene(kCamera, {SE3(), pose({0, 0.02, 0}, {0.05, 0, 0})}, 150, random);
  const auto result = initialize(scene, false, random);
  EXPECT_EQ(result.outcome.code, Code::kDegenerate) << result.outcome.reason;
  EXPECT_LT(result.median_parallax_deg, 0.6);
}

TEST(MonoInitializer, HandsOnWhatTheTwoViewsSay) {
  Random random = seeded_random(36);
  PointScene scene = make_scene(kCamera, {SE3(), kTowards}, 20, random);
  EXPECT_EQ(initialize(scene, false, random).outcome.code, Code::kTooFewData);
  scene = make_scene(kCamera, {SE3(), kTowards}, 100, random);
  spoil(kCamera, scene.px[1], 0, 1, random);
  EXPECT_EQ(initialize(scene, false, random).outcome.code, Code::kNoConsensus);
}

}  // namespace mono_initializer_test
}  // namespace placegraph
