#include <gtest/gtest.h>
#include <placegraph/frontend/planes/ground_plane.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/scenes/texture.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace ground_plane_test {

using namespace test;
using Code = Outcome::Code;
constexpr double kHeight_m = 1.6, kStep_m = 0.8;
/// Half the resolution of a car's camera, looking at the road only: with 200 px focal length the
/// far rows would be too coarse for a percent.
Camera road_camera() {
  Camera camera = pinhole(360, 190, 400);
  camera.cy = 40;
  return camera;
}
const Camera kCamera = road_camera();

/// A car's camera, pitched down, before and after a step forward with a little yaw; the motion is
/// known up to scale. Reference: after the step.
struct Drive {
  double pitch_rad = 0.03;
  double contrast = 60;
  Image image_ref, image_cur;
  SE3 T_cur_ref;  // |t| = 1
  Plane truth;    // in units of |t|

  explicit Drive(double pitch = 0.03, double contrast_grey = 60)
      : pitch_rad(pitch), contrast(contrast_grey) {
    // World: x right, y down, z forward; the ground is y = 0. Plane frame: its z axis is world -y.
    Eigen::Matrix3d R_world_ground;
    R_world_ground << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    const TexturedPlane ground{
        SE3(R_world_ground, Eigen::Vector3d::Zero()), 1e3, 1e3, {5, 1.2, 2, contrast}};
    const SE3 T_world_cur = pose({-pitch_rad, 0, 0}, {0, -kHeight_m, 0});
    const SE3 T_world_ref =
        pose({0, 0.01, 0}, {0.02, -kHeight_m, kStep_m}) * pose({-pitch_rad, 0, 0}, {0, 0, 0});
    image_ref = render(kCamera, T_world_ref, {ground}, 2).grey;
    image_cur = render(kCamera, T_world_cur, {ground}, 2).grey;
    const SE3 metric = T_world_cur.inverse() * T_world_ref;
    const double length = metric.translation().norm();
    T_cur_ref = SE3(metric.rotation(), metric.translation() / length);
    truth = {T_world_ref.rotation().inverse() * Eigen::Vector3d::UnitY(), kHeight_m / length};
  }
  double log_error(const GroundPlaneResult& result) const {
    return std::log(result.plane_ref.distance_m / truth.distance_m);
  }
  GroundPlaneResult align(double start_factor = 1.1) const {
    GroundPlaneOptions options;
    options.half_width_heights = 2;  // an empty plane: more of it tells more
    return align_ground_plane(image_ref, image_cur, kCamera, T_cur_ref,
                              {{truth.normal, start_factor * truth.distance_m}, 0.01}, options);
  }
};

TEST(GroundPlane, IsFoundToOnePercentWithoutNoise) {
  for (const double pitch_rad : {0.0, 0.05}) {
    const Drive drive(pitch_rad);
    const auto result = drive.align();
    ASSERT_TRUE(result.outcome) << result.outcome.reason;
    EXPECT_LT(std::abs(drive.log_error(result)), 0.01) << pitch_rad;
    EXPECT_LT(angle_between(result.plane_ref.normal, drive.truth.normal), deg_to_rad(0.3));
    EXPECT_GT(result.zncc, 0.95);
    EXPECT_GE(result.samples, 400);
    EXPECT_GT(result.sigma_log_distance, 0);
    EXPECT_LT(result.sigma_log_distance, 0.05);
  }
}

TEST(GroundPlane, ErrsWithinItsOwnSigmaUnderNoiseAndExposure) {
  Random random = seeded_random(61);
  Drive drive;
  const Image clean_ref = drive.image_ref, clean_cur = drive.image_cur;
  constexpr int kRuns = 3;
  double nees = 0;
  for (int run = 0; run < kRuns; ++run) {
    drive.image_ref = disturbed(clean_ref, 6, random);
    drive.image_cur = disturbed(clean_cur, 6, random, 0.9, 12);
    const auto result = drive.align(run % 2 ? 0.9 : 1.1);
    ASSERT_TRUE(result.outcome) << result.outcome.reason;
    const double deviations = drive.log_error(result) / result.sigma_log_distance;
    EXPECT_LT(std::abs(deviations), 3);
    nees += deviations * deviations / kRuns;
  }
  EXPECT_LT(nees, 5.4);  // chi2 of 3, 99.9 %, over 3
}

TEST(GroundPlane, IsFoundFromNothing) {
  const Drive drive(0.04);
  const auto result = search_ground_plane(drive.image_ref, drive.image_cur, kCamera,
                                          drive.T_cur_ref, Eigen::Vector3d::UnitY(), {});
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_LT(std::abs(drive.log_error(result)), 0.02);
  EXPECT_LT(angle_between(result.plane_ref.normal, drive.truth.normal), deg_to_rad(0.6));
}

TEST(GroundPlane, SaysNothingOfARoadWithoutTexture) {
  Random random = seeded_random(62);
  Drive drive(0.03, 0);
  EXPECT_FALSE(drive.align().outcome);
  EXPECT_FALSE(search_ground_plane(drive.image_ref, drive.image_cur, kCamera, drive.T_cur_ref,
                                   Eigen::Vector3d::UnitY(), {})
                   .outcome);
  drive.image_ref = disturbed(drive.image_ref, 4, random);
  drive.image_cur = disturbed(drive.image_cur, 4, random);
  EXPECT_FALSE(drive.align().outcome);
}

TEST(GroundPlane, IsSurerOfARoadWithMoreTexture) {
  Random random = seeded_random(63);
  double sigma[2];
  for (const int rich : {0, 1}) {
    Drive drive(0.03, rich ? 60 : 15);
    drive.image_ref = disturbed(drive.image_ref, 6, random);
    drive.image_cur = disturbed(drive.image_cur, 6, random);
    // The motion is known well, so that what remains is the picture's.
    const GroundPlanePrior prior{drive.truth, 0.05, 1e-4, 1e-3};
    const auto result =
        align_ground_plane(drive.image_ref, drive.image_cur, kCamera, drive.T_cur_ref, prior, {});
    ASSERT_TRUE(result.outcome) << result.outcome.reason;
    sigma[rich] = result.sigma_log_distance;
  }
  EXPECT_LT(sigma[1], 0.9 * sigma[0]);
}

TEST(GroundPlane, SaysWhenNoRoadIsInView) {
  const Drive drive;
  const Plane above{-drive.truth.normal, drive.truth.distance_m};
  EXPECT_FALSE(
      align_ground_plane(drive.image_ref, drive.image_cur, kCamera, drive.T_cur_ref, {above}, {})
          .outcome);
  const Plane aside{Eigen::Vector3d(0, 0.02, -1).normalized(), 1};
  EXPECT_EQ(
      align_ground_plane(drive.image_ref, drive.image_cur, kCamera, drive.T_cur_ref, {aside}, {})
          .outcome.code,
      Code::kTooFewData);
}

TEST(GroundPlane, SaysWhenTheTwoPicturesShowDifferentRoads) {
  const Drive drive;
  const Image other = texture_image(kCamera.width, kCamera.height, {8, 20, 2, 60});
  EXPECT_EQ(align_ground_plane(drive.image_ref, other, kCamera, drive.T_cur_ref, {drive.truth}, {})
                .outcome.code,
            Code::kInconsistent);
}

TEST(GroundPlane, NeedsATranslationAlongWhichTheRoadMoves) {
  const Drive drive;
  const SE3 rotation(drive.T_cur_ref.rotation(), Eigen::Vector3d::Zero());
  EXPECT_EQ(search_ground_plane(drive.image_ref, drive.image_cur, kCamera, rotation,
                                drive.truth.normal, {})
                .outcome.code,
            Code::kDegenerate);
  EXPECT_EQ(
      align_ground_plane(drive.image_ref, drive.image_cur, kCamera, rotation, {drive.truth}, {})
          .outcome.code,
      Code::kDegenerate);
}

TEST(GroundPlane, RefusesOtherSizesAndPlanesBehindTheCamera) {
  const Drive drive;
  EXPECT_THROW((void)align_ground_plane(drive.image_ref, drive.image_cur.rowRange(0, 100), kCamera,
                                        drive.T_cur_ref, {drive.truth}, {}),
               ArgumentError);
  EXPECT_THROW((void)align_ground_plane(drive.image_ref, drive.image_cur, kCamera, drive.T_cur_ref,
                                        {{drive.truth.normal, -1}}, {}),
               ArgumentError);
  GroundPlaneOptions options;
  options.near_heights = 13;
  EXPECT_THROW(options.check(), ArgumentError);
}

}  // namespace ground_plane_test
}  // namespace placegraph
