#include <gtest/gtest.h>
#include <placegraph/pipeline/local_map/stereo_rectifier.h>

#include "tests/support/saved_state.h"
#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace stereo_rectifier_test {

using namespace test;

constexpr double kBaseline_m = 0.5;

/// A drive sideways past points between 4 and 25 m, whose disparities are off by `error`.
SlidingWindow window_of(const RectificationError& error, int first_landmark = 0) {
  const Camera camera = window_camera();
  SlidingWindow window({}, camera);
  for (int k = 0; k < 5; ++k)
    window.add_keyframe(KeyframeId(k),
                        SE3(SO3::exp({0, 0.01 * k, 0}), Eigen::Vector3d(0.8 * k, 0, 0.3 * k)));
  Random random(5);
  for (int i = 0; i < 150; ++i) {
    const std::int64_t id = first_landmark + i;
    const Eigen::Vector3d point(random.uniform(-3, 6), random.uniform(-1.5, 1.5),
                                random.uniform(4, 25));
    window.add_landmark(LandmarkId(id), point);
    for (int k = 0; k < 5; ++k) {
      const Eigen::Vector3d p_cam = window.pose(KeyframeId(k)).inverse() * point;
      WindowObservation o;
      o.keyframe = KeyframeId(k);
      o.landmark = LandmarkId(id);
      o.px = *camera.project(p_cam);
      o.inverse_depth =
          1 / p_cam.z() + error.at(p_cam.head<2>() / p_cam.z()) / (camera.fx * kBaseline_m);
      o.sigma_inverse_depth = 0.3 / (camera.fx * kBaseline_m);
      window.add_observation(o);
    }
  }
  return window;
}

StereoRectifier rectifier() {
  Calibration calibration;
  calibration.camera = window_camera();
  calibration.baseline_m = kBaseline_m;
  RectificationOptions options;
  options.prior_sigma_px = 1;
  return StereoRectifier(options, calibration, 0.25, 0.3);
}

TEST(StereoRectifier, FindsWhatDisparitiesAreOffByFromTheMotionOfTheLeftCamera) {
  const RectificationError error{-0.4, 0.3, 0.2};
  SlidingWindow window = window_of(error);
  StereoRectifier r = rectifier();
  r.calibrate(window, nullptr);
  EXPECT_NEAR(r.error().offset_px, error.offset_px, 0.1);
  EXPECT_NEAR(r.error().by_x_px, error.by_x_px, 0.25);
  EXPECT_NEAR(r.error().by_y_px, error.by_y_px, 0.25);
}

TEST(StereoRectifier, CorrectsTheDisparitiesOfTheWindowByIt) {
  const RectificationError error{-0.4, 0, 0};
  SlidingWindow window = window_of(error);
  StereoRectifier r = rectifier();
  r.calibrate(window, nullptr);
  const double per_px = 1 / (window_camera().fx * kBaseline_m);
  for (const LandmarkId id : window.landmarks())
    for (const WindowObservation& o : window.observations(id)) {
      const double true_depth = (window.pose(o.keyframe).inverse() * *window.landmark(id)).z();
      EXPECT_LT(std::abs(*o.inverse_depth - 1 / true_depth), 0.2 * per_px);
    }
}

TEST(StereoRectifier, HearsEachLandmarkOnce) {
  const RectificationError error{-0.4, 0, 0};
  SlidingWindow window = window_of(error);
  StereoRectifier r = rectifier();
  r.calibrate(window, nullptr);
  const double once = r.error().offset_px;
  r.calibrate(window, nullptr);
  EXPECT_NEAR(r.error().offset_px, once, 1e-6);
}

TEST(StereoRectifier, GoesOnFromItsStateAsIfItHadNotBeenInterrupted) {
  const RectificationError error{-0.4, 0.3, 0.2};
  StereoRectifier whole = rectifier(), interrupted = rectifier();
  for (int k = 0; k < 4; ++k) {
    if (k > 0) interrupted = resumed(interrupted, rectifier());
    for (StereoRectifier* each : {&whole, &interrupted}) {
      SlidingWindow window = window_of(error, 1000 * k);
      each->calibrate(window, nullptr);
    }
    EXPECT_EQ(interrupted.error().offset_px, whole.error().offset_px) << k;
    EXPECT_EQ(interrupted.error().by_x_px, whole.error().by_x_px) << k;
    EXPECT_EQ(interrupted.error().by_y_px, whole.error().by_y_px) << k;
  }
  EXPECT_NE(whole.error().offset_px, 0);
}

TEST(StereoRectifier, LandmarksOfTooFewViewsTellNothing) {
  SlidingWindow window = window_of({-0.4, 0, 0});
  for (const LandmarkId id : window.landmarks())
    for (int k = 0; k < 2; ++k) window.remove_observation(KeyframeId(k), id);
  StereoRectifier r = rectifier();
  r.calibrate(window, nullptr);
  EXPECT_EQ(r.error().offset_px, 0);
}

TEST(StereoRectifier, APerfectPairStaysPerfect) {
  SlidingWindow window = window_of({});
  StereoRectifier r = rectifier();
  r.calibrate(window, nullptr);
  EXPECT_NEAR(r.error().offset_px, 0, 0.02);
  EXPECT_NEAR(r.error().by_x_px, 0, 0.05);
  EXPECT_NEAR(r.error().by_y_px, 0, 0.05);
}

}  // namespace stereo_rectifier_test
}  // namespace placegraph
