#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/backend/window/window_state.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/pipeline/health/window_residuals.h>

namespace placegraph {
namespace window_residuals_test {

using testing::HasSubstr;
using testing::IsEmpty;

/// Two keyframes that observe a hundred points exactly, but for the pixels of `odd_pixels` of them
/// and the depths of `odd_depths`, in the second keyframe.
SlidingWindow window_of(int odd_pixels, int odd_depths) {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 500;
  camera.cx = 320;
  camera.cy = 240;
  SlidingWindow window({}, camera);
  for (int k = 0; k < 2; ++k)
    window.add_keyframe(KeyframeId(k), SE3(SO3(), Eigen::Vector3d(0.2 * k, 0, 0)));
  Random random(3);
  for (int id = 0; id < 100; ++id) {
    const double z = random.uniform(2, 5);
    const Eigen::Vector3d p_map(z * random.uniform(-0.4, 0.4), z * random.uniform(-0.3, 0.3), z);
    window.add_landmark(LandmarkId(id), p_map);
    for (int k = 0; k < 2; ++k) {
      WindowObservation o;
      o.keyframe = KeyframeId(k);
      o.landmark = LandmarkId(id);
      o.px = *camera.project(p_map - Eigen::Vector3d(0.2 * k, 0, 0));
      if (k == 1 && id < odd_pixels) o.px.y() += 4;
      o.inverse_depth = 1 / z + (k == 1 && id < odd_depths ? 0.04 : 0);
      o.sigma_inverse_depth = 0.01;
      window.add_observation(o);
    }
  }
  return window;
}

WindowResiduals residuals_of(int odd_pixels, int odd_depths) {
  return window_residuals(window_of(odd_pixels, odd_depths).state());
}

Calibration calibration_of(bool depth_camera) {
  Calibration calibration;
  if (depth_camera) calibration.depth = DepthCamera{calibration.camera, SE3()};
  return calibration;
}

TEST(WindowResiduals, AreCounted) {
  const WindowResiduals residuals = residuals_of(7, 11);
  EXPECT_EQ(residuals.pixels, 200);
  EXPECT_EQ(residuals.odd_pixels, 7);
  EXPECT_EQ(residuals.depths, 200);
  EXPECT_EQ(residuals.odd_depths, 11);
}

TEST(ResidualCheck, AcceptsWhatNoiseAllows) {
  ResidualCheck check(calibration_of(true));
  EXPECT_THAT(check.notes(), IsEmpty());
  for (int i = 0; i < 5; ++i) check.add(residuals_of(2, 2));
  EXPECT_THAT(check.notes(), IsEmpty());
}

TEST(ResidualCheck, ReportsAStretchInWhichPointsContradictTheMotion) {
  ResidualCheck check(calibration_of(true));
  for (int i = 0; i < 5; ++i) check.add(residuals_of(i == 2 ? 12 : 0, 0));
  ASSERT_EQ(check.notes().size(), 1u);
  EXPECT_EQ(check.notes()[0].cause, NoteCause::kDrift);
  EXPECT_THAT(check.notes()[0].text, HasSubstr("in 1 of 5 stretches over 5 %"));
}

TEST(ResidualCheck, ReportsDepthsThatDoNotBelongToTheImages) {
  for (const bool depth_camera : {true, false}) {
    ResidualCheck check(calibration_of(depth_camera));
    for (int i = 0; i < 3; ++i) check.add(residuals_of(0, 20));
    ASSERT_EQ(check.notes().size(), 1u);
    EXPECT_EQ(check.notes()[0].cause,
              depth_camera ? NoteCause::kDepthMismatch : NoteCause::kRightImage);
    EXPECT_TRUE(check.notes()[0].doubts_scale);
    EXPECT_THAT(check.notes()[0].text, HasSubstr("10 % of the points'"));
  }
}

TEST(ResidualCheck, DoesNotJudgeAFewPoints) {
  ResidualCheck check(calibration_of(true));
  check.add({20, 2, 20, 2});
  EXPECT_THAT(check.notes(), IsEmpty());
}

}  // namespace window_residuals_test
}  // namespace placegraph
