#include <gtest/gtest.h>
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/backend/window/window_information.h>
#include <placegraph/pipeline/local_map/motion_uncertainty.h>

#include <cmath>

#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace motion_uncertainty_test {

using namespace test;
using E = ImagingErrors;

/// An optimized window with measured depths, whose images are those of a camera with a longer focal
/// length.
SlidingWindow window_of(double focal_error, std::uint64_t seed) {
  Random random(seed);
  WindowWorldOptions options;
  options.keyframes = 8;
  options.stereo = true;
  options.sigma_px = 0.2;
  const WindowWorld world = make_window_world(options, random);
  SlidingWindowOptions window_options;
  window_options.max_keyframes = 20;
  window_options.max_iterations = 50;
  SlidingWindow window(window_options, world.camera);
  for (std::size_t k = 0; k < world.T_map_cam.size(); ++k)
    window.add_keyframe(KeyframeId(static_cast<std::int64_t>(k)), world.T_map_cam[k],
                        0.1 * static_cast<double>(k));
  const Eigen::Vector2d centre(world.camera.cx, world.camera.cy);
  for (WindowObservation o : world.observations) {
    if (!window.landmark(o.landmark))
      window.add_landmark(o.landmark, world.points[static_cast<std::size_t>(o.landmark.value())]);
    o.px += focal_error * (o.px - centre);
    window.add_observation(o);
  }
  EXPECT_TRUE(window.optimize().outcome);
  return window;
}

double focal_deviation(const MotionUncertainty& uncertainty) {
  return std::sqrt(uncertainty.imaging_errors()(E::kFocal, E::kFocal));
}

TEST(MotionUncertainty, BeginsWithThePriorAndLearnsThatTheCalibrationIsRight) {
  MotionUncertainty uncertainty;
  const double before = focal_deviation(uncertainty);
  EXPECT_GT(before, 0.001);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) uncertainty.add_window(window_of(0, seed));
  EXPECT_LT(focal_deviation(uncertainty), 0.6 * before);
}

TEST(MotionUncertainty, AnErrorThatWindowsAgreeOnMakesAllMotionsUncertain) {
  MotionUncertainty right, wrong;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    right.add_window(window_of(0, seed));
    wrong.add_window(window_of(0.02, seed));
  }
  EXPECT_GT(focal_deviation(wrong), 0.01);
  const SlidingWindow window = window_of(0, 9);
  const AssessedMotion motion =
      assess_motion(window, KeyframeId(0), KeyframeId(4),
                    *relative_covariance(window, KeyframeId(0), KeyframeId(4)), true);
  const Vector6d by_focal = motion.by_imaging_errors.col(E::kFocal).normalized();
  const auto variance = [&](const MotionUncertainty& uncertainty) {
    const E::Vector along = motion.by_imaging_errors.transpose() * by_focal;
    return along.dot(uncertainty.imaging_errors() * along);
  };
  EXPECT_GT(variance(wrong), variance(right));
  EXPECT_GT(wrong.covariance(motion).trace(), right.covariance(motion).trace());
}

TEST(MotionUncertainty, WindowsThatContradictEachOtherTeachLess) {
  MotionUncertainty agreeing, contradicting;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    agreeing.add_window(window_of(0, seed));
    contradicting.add_window(window_of(seed % 2 == 0 ? 0.03 : -0.03, seed));
  }
  EXPECT_GT(focal_deviation(contradicting), focal_deviation(agreeing));
  const SlidingWindow window = window_of(0, 9);
  const AssessedMotion motion =
      assess_motion(window, KeyframeId(0), KeyframeId(4),
                    *relative_covariance(window, KeyframeId(0), KeyframeId(4)), true);
  EXPECT_GT(contradicting.independent_covariance(motion).trace(),
            2 * agreeing.independent_covariance(motion).trace());
}

TEST(MotionUncertainty, TheWholeIsTheSumOfItsParts) {
  MotionUncertainty uncertainty;
  for (int i = 0; i < 40; ++i)  // every other stamp is 2 ms late
    uncertainty.add_frame(i * 100'000'000LL + (i % 2) * 2'000'000, SE3(SO3(), {0, 0, 0.5 * i}));
  const SlidingWindow window = window_of(0, 9);
  const Matrix6d stated = *relative_covariance(window, KeyframeId(0), KeyframeId(4));
  const AssessedMotion motion = assess_motion(window, KeyframeId(0), KeyframeId(4), stated, true);
  const SharedErrors shared = uncertainty.by_shared_errors(motion);
  const Matrix6d whole = uncertainty.covariance(motion);
  EXPECT_LT((uncertainty.independent_covariance(motion) + shared * shared.transpose() - whole)
                .norm(),
            1e-12 * whole.norm());
  EXPECT_GT(motion.by_stamps.trace(), 0);
  EXPECT_GT((whole - shared * shared.transpose() - motion.by_observations).trace(), 0);
  const SE3 T = window.pose(KeyframeId(0)).inverse() * window.pose(KeyframeId(4));
  EXPECT_NEAR(motion.by_length.norm(), 0.004 * T.translation().norm(), 1e-9);
}

TEST(MotionUncertainty, LengthsInAnotherUnitScaleTheCovariance) {
  MotionUncertainty uncertainty;
  const SlidingWindow window = window_of(0, 9);
  const Matrix6d stated = *relative_covariance(window, KeyframeId(0), KeyframeId(4));
  const AssessedMotion motion = assess_motion(window, KeyframeId(0), KeyframeId(4), stated, true);
  const Matrix6d one = uncertainty.covariance(motion),
                 three = uncertainty.covariance(motion.scaled(3));
  EXPECT_LT((three.topLeftCorner<3, 3>() - 9 * one.topLeftCorner<3, 3>()).norm(),
            1e-12 * three.norm());
  EXPECT_LT((three.topRightCorner<3, 3>() - 3 * one.topRightCorner<3, 3>()).norm(),
            1e-12 * three.norm());
  EXPECT_EQ(Eigen::Matrix3d((three - one).bottomRightCorner<3, 3>()).norm(), 0);
}

TEST(MotionUncertainty, WithoutAScaleTheLengthOfTheMotionIsKnown) {
  const SlidingWindow window = window_of(0, 9);
  const Matrix6d stated = *relative_covariance(window, KeyframeId(0), KeyframeId(4));
  const AssessedMotion motion = assess_motion(window, KeyframeId(0), KeyframeId(4), stated, false);
  EXPECT_EQ(motion.by_length.norm(), 0);
  const SE3 T = window.pose(KeyframeId(0)).inverse() * window.pose(KeyframeId(4));
  const Eigen::RowVector3d along = (T.rotation().inverse() * T.translation()).transpose();
  EXPECT_LT((along * motion.by_imaging_errors.topRows<3>()).norm(),
            1e-9 * motion.by_imaging_errors.norm());
}

}  // namespace motion_uncertainty_test
}  // namespace placegraph
