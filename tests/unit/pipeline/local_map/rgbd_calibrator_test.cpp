#include <gtest/gtest.h>
#include <placegraph/pipeline/local_map/rgbd_calibrator.h>

#include <Eigen/LU>

#include "tests/support/saved_state.h"
#include "tests/support/scenes/window_world.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace rgbd_calibrator_test {

using namespace test;

constexpr int kKeyframes = 8;

/// The camera turns at the place, to one side and back, and moves a little.
Vector6d twist_of(int k) {
  Vector6d twist;
  twist << 0.05, 0.02 * k, 0, 0.2 * std::sin(2.0 * k), 1.2 * std::cos(1.1 * k), 0.3;
  return twist;
}

/// A turn among points of slanted surfaces, whose observations contain `errors`.
SlidingWindow window_of(const RgbdErrors& errors, RgbdCalibrator& calibrator, int first = 0) {
  const Camera camera = window_camera();
  SlidingWindow window({}, camera);
  SE3 T_map_cam;
  for (int k = 0; k < kKeyframes; ++k) {
    window.add_keyframe(KeyframeId(first + k), T_map_cam);
    calibrator.add_keyframe(KeyframeId(first + k), twist_of(k));
    T_map_cam = T_map_cam * SE3::exp(0.08 * twist_of(k));
  }
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d point(random.uniform(-3, 3), random.uniform(-2, 2), random.uniform(2, 5));
    const Eigen::Vector3d normal_map(random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), 1);
    window.add_landmark(LandmarkId(i), point);
    for (int k = 0; k < kKeyframes; ++k) {
      const SE3 T_cam_map = window.pose(KeyframeId(first + k)).inverse();
      const Eigen::Vector3d p_cam = T_cam_map * point;
      const auto px = camera.project(p_cam);
      if (!px || !camera.contains(*px)) continue;
      WindowObservation o;
      o.keyframe = KeyframeId(first + k);
      o.landmark = LandmarkId(i);
      const Eigen::Vector3d normal = T_cam_map.rotation() * normal_map;
      o.surface_cam = normal / normal.dot(p_cam);
      const Eigen::Vector3d shift =
          RgbdErrors::derivative(camera, *px, p_cam, twist_of(k), o.surface_cam) * errors.values();
      o.px = *px + shift.head<2>() + 0.2 * Eigen::Vector2d(random.normal(), random.normal());
      o.sigma_px = 0.25;
      o.inverse_depth = 1 / p_cam.z() + shift.z() + random.normal(0, 0.002);
      o.sigma_inverse_depth = 0.005;
      window.add_observation(o);
    }
  }
  return window;
}

RgbdErrors errors_of(double readout_s, double depth_time_s) {
  RgbdErrors::Vector values = RgbdErrors::Vector::Zero();
  values[RgbdErrors::kReadout] = readout_s;
  values[RgbdErrors::kDepthTime] = depth_time_s;
  return RgbdErrors(values);
}

TEST(RgbdCalibrator, FindsTheTimesOfRowsAndOfDepthsAndCorrectsTheWindow) {
  RgbdCalibrator calibrator(window_camera(), kKeyframes);
  const RgbdErrors truth = errors_of(0.025, -0.02);
  for (int pass = 0; pass < 3; ++pass) {
    SlidingWindow window = window_of(truth, calibrator, 100 * pass);
    // Later windows are observed with what is known by then.
    const RgbdErrors left(truth.values() - calibrator.errors().values());
    window = window_of(left, calibrator, 100 * pass);
    ASSERT_TRUE(window.optimize().outcome);
    EXPECT_TRUE(calibrator.calibrate(window));
  }
  EXPECT_NEAR(calibrator.errors().values()[RgbdErrors::kReadout], 0.025, 0.003);
  EXPECT_NEAR(calibrator.errors().values()[RgbdErrors::kDepthTime], -0.02, 0.003);
}

TEST(RgbdCalibrator, EarlierMotionsFollowWhatIsLearnedLater) {
  RgbdCalibrator calibrator(window_camera(), kKeyframes);
  RgbdErrors::Vector values;
  values << 0.005, 0, 0, 0.02, -0.02, 0.006, -0.004;
  const RgbdErrors truth(values);
  const SlidingWindow exact = window_of(truth, calibrator);
  SlidingWindow window = window_of(truth, calibrator);
  ASSERT_TRUE(window.optimize().outcome);
  for (int i = 0; i < kKeyframes; ++i) calibrator.add_motions(window);
  EXPECT_TRUE(calibrator.corrections().empty());  // nothing has been learned yet
  SlidingWindow later = window_of(truth, calibrator, 100);
  ASSERT_TRUE(later.optimize().outcome);
  ASSERT_TRUE(calibrator.calibrate(later));
  for (int i = 0; i < kKeyframes; ++i) calibrator.add_motions(later);
  const std::map<KeyframeId, Vector6d> corrections = calibrator.corrections();
  ASSERT_EQ(corrections.size(), kKeyframes - 1u);  // the later window has been corrected already

  double before = 0, after = 0;
  for (int k = 1; k < kKeyframes; ++k) {
    const KeyframeId from(k - 1), to(k);
    const SE3 T_true = exact.pose(from).inverse() * exact.pose(to);
    const SE3 T_found = window.pose(from).inverse() * window.pose(to);
    before += (T_true.inverse() * T_found).log().squaredNorm();
    after += (T_true.inverse() * T_found * SE3::exp(corrections.at(to))).log().squaredNorm();
  }
  EXPECT_LT(std::sqrt(after), 0.3 * std::sqrt(before));
}

// After an interruption that falls between any two windows, it knows of the camera and of all
// earlier motions what it would have known without.
TEST(RgbdCalibrator, GoesOnFromItsStateAsIfItHadNotBeenInterrupted) {
  constexpr int kWindows = 4;
  Random random = seeded_random(6);
  for (int interrupted_at = 1; interrupted_at < kWindows; ++interrupted_at) {
    RgbdCalibrator whole(window_camera(), kKeyframes), interrupted = whole;
    const RgbdErrors truth = errors_of(random.uniform(0.01, 0.03), random.uniform(-0.03, -0.01));
    for (int k = 0; k < kWindows; ++k) {
      if (k == interrupted_at)
        interrupted = resumed(interrupted, RgbdCalibrator(window_camera(), kKeyframes));
      for (RgbdCalibrator* each : {&whole, &interrupted}) {
        const RgbdErrors left(truth.values() - each->errors().values());
        SlidingWindow window = window_of(left, *each, 100 * k);
        ASSERT_TRUE(window.optimize().outcome);
        each->calibrate(window);
        for (int i = 0; i < kKeyframes; ++i) each->add_motions(window);
      }
    }
    EXPECT_EQ(interrupted.errors().values(), whole.errors().values()) << interrupted_at;
    EXPECT_GE(whole.corrections().size(), kKeyframes - 1u);
    EXPECT_EQ(interrupted.corrections(), whole.corrections()) << interrupted_at;
  }
}

TEST(RgbdCalibrator, HardlyChangesObservationsThatNothingContradicts) {
  constexpr double kChi2 = 24.3;  // 99.9 % of seven degrees of freedom
  RgbdCalibrator calibrator(window_camera(), kKeyframes);
  const SlidingWindow before = window_of(RgbdErrors(), calibrator);
  SlidingWindow window = window_of(RgbdErrors(), calibrator);
  ASSERT_TRUE(window.optimize().outcome);
  calibrator.calibrate(window);
  const auto [errors, covariance, dispersion] = calibrator.estimate(std::nullopt);
  EXPECT_LT(errors.dot(covariance.inverse() * errors), kChi2);
  for (const LandmarkId id : window.landmarks()) {
    const auto then = before.observations(id), now = window.observations(id);
    for (std::size_t i = 0; i < then.size(); ++i)
      EXPECT_LT((now[i].px - then[i].px).norm(), 4 * then[i].sigma_px);
  }
}

TEST(RgbdErrors, DisplaceAPointAsItMovesInTheTimeOfItsRow) {
  const Camera camera = window_camera();
  const Eigen::Vector3d p_cam(0.6, 0.5, 3);
  const Eigen::Vector2d px = *camera.project(p_cam);
  const double readout_s = 0.02;
  const double later_s = readout_s * (px.y() - 0.5 * (camera.height - 1)) / camera.height;
  const SE3 T_cam_later = SE3::exp(later_s * twist_of(1));
  const Eigen::Vector2d moved = *camera.project(T_cam_later.inverse() * p_cam) - px;
  const Eigen::Vector2d predicted =
      errors_of(readout_s, 0).displacement_px(camera, px, p_cam, twist_of(1));
  EXPECT_GT(moved.norm(), 0.5);
  EXPECT_LT((predicted - moved).norm(), 0.05 * moved.norm());
}

TEST(RgbdErrors, ADisplacedDepthImageIsReadBesideThePixel) {
  const Camera camera = window_camera();
  const Eigen::Vector3d surface(0.4, -0.2, 0.3), ray = *camera.unproject({200, 90});
  RgbdErrors::Vector values = RgbdErrors::Vector::Zero();
  values[RgbdErrors::kDepthX] = 0.01;
  values[RgbdErrors::kDepthY] = -0.02;
  const RgbdErrors errors(values);
  // The inverse depth of the plane g^T X = 1 on a ray is g^T ray.
  const double here = surface.dot(ray), beside = surface.dot(ray - Eigen::Vector3d(0.01, -0.02, 0));
  const Eigen::Vector3d effect =
      errors.effect(camera, {200, 90}, ray / here, Vector6d::Zero(), surface);
  EXPECT_LT(effect.head<2>().norm(), 1e-12);
  EXPECT_NEAR(effect.z(), beside - here, 1e-12);
  DepthCamera depth;
  depth.camera = camera;
  const Camera corrected = errors.corrected(depth, Vector6d::Zero()).camera;
  EXPECT_NEAR(corrected.cx - camera.cx, 0.01 * camera.fx, 1e-9);
  EXPECT_NEAR(corrected.cy - camera.cy, -0.02 * camera.fy, 1e-9);
}

TEST(RgbdErrors, PlaceTheDepthCameraAtTheTimeOfItsImage) {
  DepthCamera depth;
  depth.camera = window_camera();
  const DepthCamera corrected = errors_of(0, -0.02).corrected(depth, twist_of(1));
  const SE3 expected = SE3::exp(-0.02 * twist_of(1));
  EXPECT_LT((corrected.T_cam_depth.matrix() - expected.matrix()).norm(), 1e-12);
}

}  // namespace rgbd_calibrator_test
}  // namespace placegraph
