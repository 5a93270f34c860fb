#include <gtest/gtest.h>
#include <placegraph/frontend/align/direct_motion.h>
#include <placegraph/frontend/flow/grey_pyramid.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>
#include <opencv2/core.hpp>

#include "tests/support/scenes/scene.h"
#include "tests/support/scenes/texture.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace direct_motion_test {

using namespace test;
using Code = Outcome::Code;
constexpr double kHeight_m = 1.6;

Camera road_camera() {
  Camera camera = pinhole(320, 160, 300);
  camera.cy = 40;
  return camera;
}

/// A camera over the ground, with a wall on the left that may be there, before and after a motion.
struct Street {
  Camera camera = road_camera();
  SE3 T_ref_cur;
  Image image_ref, image_cur;
  std::vector<SurfacePatch> patches;

  explicit Street(bool wall, const SE3& motion = pose({0.002, 0.02, -0.003}, {0.03, -0.01, 0.8}))
      : T_ref_cur(motion) {
    Eigen::Matrix3d R_ground, R_wall;
    R_ground << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    R_wall << 0, 0, 1, 0, 1, 0, -1, 0, 0;
    std::vector<TexturedPlane> planes;
    planes.push_back({SE3(R_ground, Eigen::Vector3d(0, kHeight_m, 0)), 1e3, 1e3, {5, 0.8, 2, 60}});
    if (wall) planes.push_back({SE3(R_wall, Eigen::Vector3d(-3, 0, 0)), 1e3, 1e3, {9, 0.8, 2, 60}});
    image_ref = render(camera, SE3(), planes, 2).grey;
    image_cur = render(camera, T_ref_cur, planes, 2).grey;
    SurfacePatch ground;
    ground.g_ref = Eigen::Vector3d::UnitY() / kHeight_m;
    SurfacePatch side;
    side.g_ref = -Eigen::Vector3d::UnitX() / 3;
    ground.reach_px = side.reach_px = 4;
    for (int v = 60; v < 150; v += 8)
      for (int u = 8; u < 312; u += 8) {
        const auto ray = *camera.unproject({static_cast<double>(u), static_cast<double>(v)});
        const double on_ground = ground.g_ref.dot(ray), on_wall = wall ? side.g_ref.dot(ray) : 0;
        if (std::abs(on_ground - on_wall) < 0.05) continue;
        (on_ground > on_wall ? ground : side)
            .support_px.emplace_back(static_cast<float>(u), static_cast<float>(v));
      }
    patches.push_back(ground);
    if (wall) patches.push_back(side);
  }
  DirectMotion align(const SE3& start, const DirectMotionOptions& options = {}) const {
    const DirectReference reference(grey_pyramid(image_ref, options.levels), camera, patches,
                                    options);
    return align_motion(reference, grey_pyramid(image_cur, options.levels), start, {});
  }
  Vector6d error(const DirectMotion& motion) const {
    return (T_ref_cur.inverse() * motion.T_ref_cur).log();
  }
};

TEST(DirectMotion, OneKnownPlaneTellsTheWholeMotion) {
  const Street street(false);
  const DirectMotion motion =
      street.align(street.T_ref_cur * pose({0.004, -0.004, 0.003}, {0.05, 0.02, -0.1}));
  ASSERT_TRUE(motion.outcome) << motion.outcome.reason;
  // A hundredth of a pixel of rotation is 3e-5; pitch and height are told apart a tenth as well.
  EXPECT_LT(street.error(motion).tail<3>().norm(), 1e-3);
  EXPECT_LT(street.error(motion).head<3>().norm(), 0.01);
  EXPECT_GT(motion.agreement, 0.95);
  EXPECT_GT(motion.inlier_share, 0.9);
}

TEST(DirectMotion, OfTwoPlanesIsKnownBetterThanOfOne) {
  const Street alone(false), both(true);
  const DirectMotion of_one = alone.align(alone.T_ref_cur), of_two = both.align(both.T_ref_cur);
  ASSERT_TRUE(of_one.outcome);
  ASSERT_TRUE(of_two.outcome) << of_two.outcome.reason;
  EXPECT_EQ(of_two.planes.size(), 2u);
  EXPECT_LT(both.error(of_two).head<3>().norm(), 0.01);
  EXPECT_LT(of_two.covariance(1, 1), of_one.covariance(1, 1));
}

TEST(DirectMotion, ExposureOfEachPlaneIsItsOwn) {
  Street street(true);
  street.image_cur.convertTo(street.image_cur, -1, 0.8, 12);
  const DirectMotion motion = street.align(street.T_ref_cur);
  ASSERT_TRUE(motion.outcome) << motion.outcome.reason;
  EXPECT_LT(street.error(motion).head<3>().norm(), 0.01);
  for (const auto& plane : motion.planes) EXPECT_NEAR(plane.gain, 0.8, 0.03);
}

TEST(DirectMotion, APlaneKnownRoughlyIsCorrected) {
  Street street(false);
  const Eigen::Vector3d tilted =
      pose({0.02, 0, 0}, {0, 0, 0}).rotation() * Eigen::Vector3d::UnitY();
  street.patches[0].g_ref = tilted / kHeight_m;
  const Eigen::Matrix3d along = tilted * tilted.transpose();
  street.patches[0].g_covariance =
      (4e-4 * (Eigen::Matrix3d::Identity() - along) + 1e-6 * along) / (kHeight_m * kHeight_m);
  const DirectMotion motion = street.align(street.T_ref_cur);
  ASSERT_TRUE(motion.outcome) << motion.outcome.reason;
  EXPECT_LT(angle_between(motion.planes[0].g_ref.normalized(), Eigen::Vector3d::UnitY()), 0.005);
  EXPECT_LT(std::abs(street.error(motion).z()), 0.02);
  EXPECT_GT(std::sqrt(motion.covariance(2, 2)), 1e-3);  // the plane's uncertainty is in it
}

TEST(DirectMotion, ErrsByWhatItsCovarianceSays) {
  Random random = seeded_random(17);
  const Street clean(true);
  constexpr int kRuns = 8;
  double nees = 0;
  for (int run = 0; run < kRuns; ++run) {
    Street street = clean;
    for (Image* image : {&street.image_ref, &street.image_cur})
      *image = disturbed(*image, 4, random);
    const DirectMotion motion = street.align(street.T_ref_cur);
    ASSERT_TRUE(motion.outcome) << motion.outcome.reason;
    const Vector6d e = street.error(motion);
    nees += e.dot(motion.covariance.ldlt().solve(e)) / 6 / kRuns;
  }
  EXPECT_GT(nees, 0.3);
  EXPECT_LT(nees, 2.5);
}

TEST(DirectMotion, ASearchFindsAStepFarOff) {
  const Street street(false);
  DirectMotionOptions options;
  const DirectReference reference(grey_pyramid(street.image_ref, options.levels), street.camera,
                                  street.patches, options);
  const auto pyramid = grey_pyramid(street.image_cur, options.levels);
  Vector6d sigmas;
  sigmas << 0.1, 0.05, 0.6, 0.005, 0.02, 0.005;
  const SE3 start =
      search_motion(reference, pyramid, pose({0, 0, 0}, {0, 0, 0.6}), sigmas, options);
  const DirectMotion motion = align_motion(reference, pyramid, start, {});
  ASSERT_TRUE(motion.outcome) << motion.outcome.reason;
  EXPECT_LT(street.error(motion).head<3>().norm(), 0.01);
}

TEST(DirectMotion, SaysWhyThereIsNone) {
  Street street(false);
  EXPECT_EQ(street.align(pose({0, 1.5, 0}, {0, 0, 0})).outcome.code, Code::kTooFewData);
  Street other(false);
  other.image_cur = Image(street.image_cur.size(), CV_8UC1, cv::Scalar(90));
  EXPECT_FALSE(other.align(street.T_ref_cur).outcome);
  Street strange(false);
  cv::flip(street.image_ref, strange.image_cur, 1);
  EXPECT_FALSE(strange.align(street.T_ref_cur).outcome);
}

}  // namespace direct_motion_test
}  // namespace placegraph
