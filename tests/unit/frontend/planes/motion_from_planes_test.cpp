#include <gtest/gtest.h>
#include <placegraph/frontend/planes/motion_from_planes.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/planes_world.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace motion_from_planes_test {

using namespace test;

const SE3 kMotion = pose({0.02, -0.06, 0.03}, {0.9, -0.2, 0.4});

/// The regions as they truly are, homographies from all their matches.
PlanarRegionsResult true_regions(const PlanesWorld& world, double sigma_px) {
  PlanarRegionsResult regions;
  regions.outcome = Outcome::ok();
  regions.labels = world.labels;
  regions.noise.sigma_px = sigma_px;
  for (std::size_t k = 0; k < world.planes_ref.size(); ++k) {
    std::vector<int> which;
    for (int i = 0; i < world.matches.size(); ++i)
      if (world.labels[i] == static_cast<int>(k) + 1) which.push_back(i);
    const HomographyFit fit = refine_homography(
        homography_from_plane(world.camera.K(), world.T_cur_ref, world.planes_ref[k]),
        world.matches, which, regions.noise, 10);
    regions.regions.push_back(
        {fit.H_cur_ref, fit.covariance, static_cast<int>(which.size()), fit.cost});
  }
  return regions;
}

double direction_error_rad(const PlanesReading& reading, const SE3& T_cur_ref) {
  return angle_between(reading.T_cur_ref.translation(), T_cur_ref.translation());
}

TEST(MotionFromPlanes, FindsTheOneMotionBehindTwoToFourPlanes) {
  Random random = seeded_random(81);
  for (int planes = 2; planes <= 4; ++planes) {
    const PlanesWorld world = make_planes_world(planes, 60, 0, 0.1, kMotion, random);
    const MotionFromPlanesResult result =
        motion_from_planes(world.camera, world.matches, true_regions(world, 0.1), {});
    ASSERT_TRUE(result.outcome) << result.outcome.reason;
    ASSERT_EQ(result.readings.size(), 1u);
    const PlanesReading& best = result.readings[0];
    EXPECT_NEAR(best.T_cur_ref.translation().norm(), 1, 1e-12);
    EXPECT_LT(angle_rad(best.T_cur_ref, kMotion), 2e-3);
    EXPECT_LT(direction_error_rad(best, kMotion), 1e-2);
    for (int k = 0; k < planes; ++k) {
      EXPECT_LT(angle_between(best.planes_ref[k].normal, world.planes_ref[k].normal), 0.03);
      EXPECT_NEAR(best.planes_ref[k].distance_m * kMotion.translation().norm(),
                  world.planes_ref[k].distance_m, 0.15);
    }
  }
}

TEST(MotionFromPlanes, StatesTheUncertaintyOfTheMotionTruly) {
  // Normalized squared errors of five degrees of freedom: their mean over 40 runs is 5 +- 0.5.
  Random random = seeded_random(82);
  double sum = 0;
  constexpr int kRuns = 40;
  for (int run = 0; run < kRuns; ++run) {
    const PlanesWorld world = make_planes_world(3, 30, 0, 0.3, kMotion, random);
    const MotionFromPlanesResult result =
        motion_from_planes(world.camera, world.matches, true_regions(world, 0.3), {});
    ASSERT_TRUE(result.outcome) << result.outcome.reason;
    const PlanesReading& best = result.readings[0];
    const SE3 truth(kMotion.rotation(), kMotion.translation().normalized());
    const Eigen::Matrix<double, 6, 1> error = (best.T_cur_ref.inverse() * truth).log();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(best.covariance);
    EXPECT_LT(std::abs(eigen.eigenvalues()[0]), 1e-9 * eigen.eigenvalues()[5]);
    const Eigen::Matrix<double, 6, 1> y = eigen.eigenvectors().transpose() * error;
    for (int i = 1; i < 6; ++i) sum += y[i] * y[i] / eigen.eigenvalues()[i];
  }
  EXPECT_NEAR(sum / kRuns, 5, 4 * 0.5);
}

TEST(MotionFromPlanes, KeepsBothReadingsOfOnePlane) {
  // Where points of the plane would lie behind a camera in the other reading, there is one.
  Random random = seeded_random(83);
  int with_both = 0;
  for (int w = 0; w < 40; ++w) {
    const PlanesWorld world = make_planes_world(1, 100, 0, 0.1, kMotion, random);
    const MotionFromPlanesResult result =
        motion_from_planes(world.camera, world.matches, true_regions(world, 0.1), {});
    ASSERT_TRUE(result.outcome) << result.outcome.reason;
    double least = 1;
    for (const PlanesReading& reading : result.readings)
      least = std::min(least, angle_rad(reading.T_cur_ref, kMotion));
    EXPECT_LT(least, 5e-3);
    if (result.readings.size() != 2) continue;
    ++with_both;
    EXPECT_NEAR(result.readings[0].cost, result.readings[1].cost, 1e-3);
  }
  EXPECT_GE(with_both, 3);
}

TEST(MotionFromPlanes, SaysThatTheCameraOnlyRotated) {
  Random random = seeded_random(84);
  const SE3 pure_rotation = pose({0.02, -0.1, 0.03}, {0, 0, 0});
  for (int planes = 1; planes <= 3; ++planes) {
    const PlanesWorld world = make_planes_world(planes, 50, 0, 0.3, pure_rotation, random);
    const MotionFromPlanesResult result =
        motion_from_planes(world.camera, world.matches, true_regions(world, 0.3), {});
    EXPECT_EQ(result.outcome.code, Outcome::Code::kDegenerate);
    EXPECT_TRUE(result.readings.empty());
    ASSERT_TRUE(result.R_cur_ref);
    EXPECT_LT((result.R_cur_ref->inverse() * pure_rotation.rotation()).log().norm(), 1e-3);
  }
}

TEST(MotionFromPlanes, GoesTogetherWithTheSearchForPlanes) {
  Random random = seeded_random(85);
  const PlanesWorld world = make_planes_world(3, 50, 40, 0.3, kMotion, random);
  const PlanarRegionsResult regions = find_planar_regions(world.matches, {}, random);
  ASSERT_TRUE(regions.outcome);
  const MotionFromPlanesResult result =
      motion_from_planes(world.camera, world.matches, regions, {});
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_LT(angle_rad(result.readings[0].T_cur_ref, kMotion), 0.02);
  EXPECT_LT(direction_error_rad(result.readings[0], kMotion), 0.08);
}

TEST(MotionFromPlanes, RefusesWhatItCannotRead) {
  Random random = seeded_random(86);
  const PlanesWorld world = make_planes_world(2, 30, 0, 0.1, kMotion, random);
  PlanarRegionsResult regions = true_regions(world, 0.1);
  Camera distorted = world.camera;
  distorted.distortion = Distortion::kRadialTangential;
  EXPECT_THROW((void)motion_from_planes(distorted, world.matches, regions, {}), ArgumentError);
  PlanarRegionsResult none;
  none.labels.assign(world.labels.size(), 0);
  EXPECT_EQ(motion_from_planes(world.camera, world.matches, none, {}).outcome.code,
            Outcome::Code::kTooFewData);
  regions.labels.pop_back();
  EXPECT_THROW((void)motion_from_planes(world.camera, world.matches, regions, {}), ArgumentError);
}

TEST(MotionFromPlanes, SaysThatPlanesMoveEachTheirOwnWay) {
  // A second plane that slides past on its own: seen from behind in every common motion or fitted
  // badly; in no case are the readings as good as the free homographies.
  Random random = seeded_random(87);
  PlanesWorld world = make_planes_world(2, 60, 0, 0.2, kMotion, random);
  for (std::size_t i = 60; i < 120; ++i) world.matches.px_cur[i] += Eigen::Vector2d(0, 40);
  const MotionFromPlanesResult result =
      motion_from_planes(world.camera, world.matches, true_regions(world, 0.2), {});
  EXPECT_EQ(result.outcome.code, Outcome::Code::kInconsistent);
}

}  // namespace motion_from_planes_test
}  // namespace placegraph
