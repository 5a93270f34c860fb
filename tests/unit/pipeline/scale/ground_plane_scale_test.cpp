#include <gtest/gtest.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/scale/ground_plane_scale.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/scenes/texture.h"

namespace placegraph {
namespace ground_plane_scale_test {

using namespace test;
constexpr double kHeight_m = 1.6, kStep_m = 0.8, kPitch_rad = 0.04;
/// Half the resolution of a car's camera, looking at the road only: with 200 px focal length the
/// far rows would be too coarse for a percent.
Camera road_camera() {
  Camera camera = pinhole(360, 190, 400);
  camera.cy = 40;
  return camera;
}
const Camera kCamera = road_camera();

SE3 T_world_cam(double forward_m) { return pose({-kPitch_rad, 0, 0}, {0, -kHeight_m, forward_m}); }

Image road(double forward_m) {
  Eigen::Matrix3d R_world_ground;
  R_world_ground << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const TexturedPlane ground{
      SE3(R_world_ground, Eigen::Vector3d::Zero()), 1e3, 1e3, {5, 1.2, 2, 60}};
  return render(kCamera, T_world_cam(forward_m), {ground}, 2).grey;
}

/// The step between the two pictures, `factor` times too long.
SE3 T_old_new(double factor) {
  const SE3 metric = T_world_cam(0).inverse() * T_world_cam(kStep_m);
  return metric.scaled(factor);
}

class GroundScaleOnARoad : public testing::Test {
 protected:
  const Image old_ = road(0), new_ = road(kStep_m);
  GroundPlaneScale scale_{{}, kCamera, kHeight_m};
};

TEST_F(GroundScaleOnARoad, FindsTheLengthOfAMotionKnownUpToScale) {
  const auto length = scale_.find(new_, old_, T_old_new(1 / kStep_m));  // |t| = 1
  ASSERT_TRUE(length);
  EXPECT_NEAR(length->factor, kStep_m, 0.02 * kStep_m);
  EXPECT_GE(length->sigma_relative, GroundPlaneScaleOptions{}.sigma_relative);
  EXPECT_LT(length->sigma_relative, 0.06);
}

TEST_F(GroundScaleOnARoad, LearnsThePitchOfItsMounting) {
  EXPECT_LT(angle_between(scale_.plane_cam().normal, Eigen::Vector3d::UnitY()), 1e-12);
  EXPECT_DOUBLE_EQ(scale_.plane_cam().distance_m, kHeight_m);
  ASSERT_TRUE(scale_.find(new_, old_, T_old_new(1)));
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(scale_.follow(new_, old_, T_old_new(1)));
  const Eigen::Vector3d truth = T_world_cam(0).rotation().inverse() * Eigen::Vector3d::UnitY();
  EXPECT_LT(angle_between(scale_.plane_cam().normal, truth), 0.5 * kPitch_rad);
  EXPECT_DOUBLE_EQ(scale_.plane_cam().distance_m, kHeight_m);
}

TEST_F(GroundScaleOnARoad, CorrectsAScaleThatIsRoughlyRight) {
  ASSERT_TRUE(scale_.find(new_, old_, T_old_new(1)));
  for (const double wrong : {0.88, 1.0, 1.12}) {
    const auto length = scale_.follow(new_, old_, T_old_new(wrong));
    ASSERT_TRUE(length) << wrong;
    EXPECT_NEAR(length->factor * wrong, 1, 0.02);
  }
}

TEST_F(GroundScaleOnARoad, MeasuresAMotionBackwardsAsThatForwards) {
  GroundPlaneScale backwards({}, kCamera, kHeight_m);
  for (const double factor : {1 / kStep_m, 1.0, 1.12}) {
    const auto forth = factor == 1 / kStep_m ? scale_.find(new_, old_, T_old_new(factor))
                                             : scale_.follow(new_, old_, T_old_new(factor));
    const SE3 T_new_old = T_old_new(factor).inverse();
    const auto back = factor == 1 / kStep_m ? backwards.find(old_, new_, T_new_old)
                                            : backwards.follow(old_, new_, T_new_old);
    ASSERT_TRUE(forth && back);
    EXPECT_NEAR(back->factor, forth->factor, 1e-9 * forth->factor);
  }
}

TEST_F(GroundScaleOnARoad, DoesNotAcceptAJumpUntilItLasts) {
  GroundPlaneScaleOptions options;
  options.max_log_jump = 0.1;
  GroundPlaneScale scale(options, kCamera, kHeight_m);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(scale.follow(new_, old_, T_old_new(1)));
  EXPECT_FALSE(scale.follow(new_, old_, T_old_new(1.2)));
  EXPECT_TRUE(scale.follow(new_, old_, T_old_new(1)));
  int refused = 0;
  while (refused < 10 && !scale.follow(new_, old_, T_old_new(1.2))) ++refused;
  EXPECT_GE(refused, 1);
  EXPECT_LT(refused, 10);
}

TEST_F(GroundScaleOnARoad, LooksOnlyWhereTheMaskAllowsIt) {
  // A van's side in the left half of the newer picture: without the mask it would be measured too.
  Image covered = new_.clone();
  const cv::Rect van(0, 0, kCamera.width / 2 - 10, kCamera.height);
  covered(van) = road(4 * kStep_m)(van);
  Image mask(kCamera.height, kCamera.width, CV_8UC1, cv::Scalar(255));
  mask(van).setTo(0);
  const auto length = scale_.follow(covered, old_, T_old_new(1), {mask, {}});
  ASSERT_TRUE(length);
  EXPECT_NEAR(length->factor, 1, 0.03);
  EXPECT_FALSE(scale_.follow(new_, old_, T_old_new(1), {Image::zeros(mask.size(), CV_8UC1), {}}));
  EXPECT_THROW((void)scale_.follow(new_, old_, T_old_new(1), {Image(4, 4, CV_8UC1), {}}),
               ArgumentError);
}

TEST_F(GroundScaleOnARoad, TakesALevelFloorAsEdgesTellIt) {
  const Eigen::Vector3d down = T_world_cam(0).rotation().inverse() * Eigen::Vector3d::UnitY();
  const auto found = scale_.find(new_, old_, T_old_new(1), {{}, down});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->factor, 1, 0.01);
  GroundPlaneScale fresh({}, kCamera, kHeight_m);
  const auto known = fresh.follow(new_, old_, T_old_new(1), {{}, down});
  ASSERT_TRUE(known);
  EXPECT_NEAR(known->factor, 1, 0.01);
  // One that is a degree off is believed as well, and the length with it; not if it is told
  // unsurely.
  const Eigen::Vector3d wrong = SO3::exp({kRadPerDeg, 0, 0}) * down;
  const auto misled = fresh.follow(new_, old_, T_old_new(1), {{}, wrong});
  const auto unsure = fresh.follow(new_, old_, T_old_new(1), {{}, wrong, 0.05});
  ASSERT_TRUE(misled && unsure);
  EXPECT_GT(std::abs(misled->factor - 1), 2 * std::abs(unsure->factor - 1));
  EXPECT_GT(std::abs(misled->factor - 1), 0.02);
}

TEST_F(GroundScaleOnARoad, RefusesALevelThatItsMountingDoesNotAllow) {
  const Eigen::Vector3d down = T_world_cam(0).rotation().inverse() * Eigen::Vector3d::UnitY();
  EXPECT_TRUE(scale_.may_be_ground(down));
  EXPECT_FALSE(scale_.may_be_ground(SO3::exp({deg_to_rad(20), 0, 0}) * down));
  EXPECT_FALSE(scale_.may_be_ground(-down));
}

TEST_F(GroundScaleOnARoad, SaysNothingWithoutTextureAndRefusesNoHeight) {
  const Image flat(kCamera.height, kCamera.width, CV_8UC1, cv::Scalar(100));
  EXPECT_FALSE(scale_.find(flat, flat, T_old_new(1)));
  EXPECT_FALSE(scale_.follow(flat, flat, T_old_new(1)));
  EXPECT_THROW(GroundPlaneScale({}, kCamera, 0), ArgumentError);
}

}  // namespace ground_plane_scale_test
}  // namespace placegraph
