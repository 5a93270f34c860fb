#include <gtest/gtest.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/lens_correction.h>
#include <placegraph/pipeline/local_map/lens_estimator.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace lens_test {

/// Of a window that says k1, to `sigma`.
DistortionEvidence window_of(double k1, double sigma) {
  const double information = 1 / (sigma * sigma);
  return {-k1 * information, information, 1000};
}

/// Of a window that looks `view_deg` to the right of the first one, moves along `direction_cam` and
/// rotates by `rotation_deg`.
WindowMotion motion(double view_deg, const Eigen::Vector3d& direction_cam,
                    double rotation_deg = 0) {
  return {SO3::exp({0, deg_to_rad(view_deg), 0}), direction_cam,
          SO3::exp({0, deg_to_rad(rotation_deg), 0})};
}

const Eigen::Vector3d kAhead = Eigen::Vector3d::UnitZ(), kBack = -Eigen::Vector3d::UnitZ();

TEST(LensStretches, AreAveraged) {
  LensStretches lens;
  EXPECT_EQ(lens.estimate().k1, 0);
  EXPECT_TRUE(std::isinf(lens.estimate().sigma_k1));
  lens.add(window_of(0.02, 0.001));
  lens.add(window_of(0.03, 0.001));
  EXPECT_NEAR(lens.estimate().k1, 0.025, 1e-4);
  const double sigma = lens.estimate().sigma_k1;
  lens.add({});  // a window that saw nothing
  EXPECT_NEAR(lens.estimate().k1, 0.025, 1e-4);
  EXPECT_EQ(lens.estimate().sigma_k1, sigma);
}

TEST(LensStretches, AreNearTheirPriorWhereTheImagesShowNothing) {
  LensStretches lens;
  for (int i = 0; i < 5; ++i) lens.add(window_of(0.5, 2));
  EXPECT_LT(std::abs(lens.estimate().k1), 0.02);
  EXPECT_LT(lens.estimate().sigma_k1, 0.2);
}

TEST(LensStretches, CountByTheirWeight) {
  LensStretches lens;
  for (int i = 0; i < 3; ++i) lens.add(window_of(0.03, 0.001));
  EXPECT_NEAR(lens.estimate().stretches, 3, 1e-6);
  const double sigma = lens.estimate().sigma_k1;
  lens.add(window_of(0.03, 0.2));
  EXPECT_NEAR(lens.estimate().stretches, 3, 0.01);
  EXPECT_NEAR(lens.estimate().sigma_k1, sigma, 0.1 * sigma);
  lens.add(window_of(0.03, 0.001));
  EXPECT_NEAR(lens.estimate().stretches, 4, 0.01);
}

TEST(LensStretches, AreAsUncertainAsRecordingsShowedUntilThereAreMany) {
  LensStretches lens;
  lens.add(window_of(0.02, 1e-4));
  const double one = lens.estimate().sigma_k1;
  EXPECT_GT(one, 0.012);
  for (int i = 0; i < 3; ++i) lens.add(window_of(0.02, 1e-4));
  const double four = lens.estimate().sigma_k1;
  EXPECT_GT(four, 0.004);
  EXPECT_LT(four, one / 2);
  for (int i = 0; i < 1000; ++i) lens.add(window_of(0.014, 1e-4));
  EXPECT_GE(lens.estimate().sigma_k1, 0.003);  // they share an error
  EXPECT_FALSE(is_clear(lens.estimate(), {}));
}

TEST(LensStretches, ThatContradictEachOtherWidenIt) {
  LensStretches agreeing, contradicting;
  for (int i = 0; i < 6; ++i) {
    agreeing.add(window_of(0.03, 0.001));
    contradicting.add(window_of(i % 2 ? 0.05 : 0.01, 0.001));
  }
  EXPECT_NEAR(agreeing.estimate().k1, contradicting.estimate().k1, 3e-4);
  EXPECT_GT(contradicting.estimate().sigma_k1, 1.5 * agreeing.estimate().sigma_k1);
  EXPECT_NEAR(contradicting.estimate().sigma_k1, 0.02 / std::sqrt(5), 0.002);
}

TEST(LensStretches, WindowsOfSimilarViewAndMotionAreOne) {
  LensStretches lens;
  const auto count = [&] { return static_cast<int>(std::lround(lens.estimate().stretches)); };
  for (const double view_deg : {0, 5, 10, 20})
    lens.add(window_of(0.02, 1e-4), motion(view_deg, kAhead));
  EXPECT_EQ(count(), 1);
  lens.add(window_of(0.02, 1e-4), motion(0, kBack));
  lens.add(window_of(0.02, 1e-4), motion(90, kAhead));
  lens.add(window_of(0.02, 1e-4), motion(10, kAhead, 40));
  EXPECT_EQ(count(), 4);
  lens.add(window_of(0.02, 1e-4), motion(2, kAhead, 5));  // the first one again
  lens.add({}, motion(180, kAhead));
  EXPECT_EQ(count(), 4);
}

TEST(LensStretches, TheSameStreetToAndFroProvesNothing) {
  LensStretches lens;
  for (int pass = 0; pass < 40; ++pass)
    lens.add(window_of(0.0147 + 1e-4 * (pass % 3), 0.001), motion(0, pass % 2 ? kBack : kAhead));
  EXPECT_NEAR(lens.estimate().k1, 0.0148, 1e-4);
  EXPECT_FALSE(is_clear(lens.estimate(), {}));
  // Nor does a round through four streets, driven again and again.
  for (int pass = 0; pass < 40; ++pass)
    lens.add(window_of(0.0147, 0.001), motion(90 * (pass % 4), kAhead));
  EXPECT_FALSE(is_clear(lens.estimate(), {}));
}

TEST(LensStretches, ALargeDistortionOfOneStretchIsClearButIsNotRemoved) {
  LensStretches lens;
  for (int i = 0; i < 4; ++i) lens.add(window_of(0.08, 0.002), motion(0, kAhead));
  EXPECT_TRUE(is_clear(lens.estimate(), {}));
  EXPECT_FALSE(is_distorted(lens.estimate(), {}));
  lens.add(window_of(0.08, 0.002), motion(60, kAhead, 40));
  EXPECT_TRUE(is_distorted(lens.estimate(), {}));
}

TEST(LensStretches, ADistortionThatHardlyMovesTheTracksIsNoneHoweverSure) {
  LensOptions options;
  LensStretches lens;
  for (int i = 0; i < 6; ++i) lens.add({-0.04 * 1e6, 1e6, 1'000'000'000});
  EXPECT_LT(lens.estimate().effect, options.min_effect);
  EXPECT_GT(lens.estimate().k1, options.min_sigmas * lens.estimate().sigma_k1);
  EXPECT_FALSE(is_distorted(lens.estimate(), options));
  options.min_effect = 0;
  EXPECT_TRUE(is_distorted(lens.estimate(), options));
}

TEST(LensStretches, CallALensDistortedByProofAndEffect) {
  LensOptions options;
  LensStretches clear, unsure;
  for (int i = 0; i < 6; ++i) {
    clear.add(window_of(0.04 + 1e-3 * (i % 2), 0.003));
    unsure.add(window_of(i % 2 ? 0.1 : -0.06, 0.003));
  }
  EXPECT_NEAR(clear.estimate().effect, 0.0405 / 0.003 / std::sqrt(1000), 2e-3);
  EXPECT_TRUE(is_distorted(clear.estimate(), options));
  EXPECT_FALSE(is_distorted(unsure.estimate(), options));
  options.enabled = false;
  EXPECT_FALSE(is_clear(clear.estimate(), options));
  options.min_sigmas = -1;
  EXPECT_THROW(options.check(), ArgumentError);
}

TEST(LensEstimator, HearsWindowsThatShareNoKeyframe) {
  Random random(3);
  test::WindowWorldOptions drive;
  drive.keyframes = 12;
  drive.noise_px = 0.3;
  const test::WindowWorld world = test::make_window_world(drive, random);
  LensEstimator lens;
  const auto observe = [&](std::int64_t first, std::int64_t last) {
    SlidingWindow window({}, world.camera);
    for (std::int64_t id = first; id <= last; ++id) {
      window.add_keyframe(KeyframeId(id), world.T_map_cam[static_cast<std::size_t>(id)]);
      test::add_view(window, world, KeyframeId(id), 0, random);
    }
    return lens.observe(window);
  };
  EXPECT_FALSE(lens.observe(SlidingWindow({}, world.camera)));
  EXPECT_TRUE(observe(0, 5));
  const double once = lens.estimate().k1;
  EXPECT_NE(once, 0);
  EXPECT_FALSE(observe(0, 5));
  EXPECT_FALSE(observe(5, 10));  // one keyframe in common
  EXPECT_EQ(lens.estimate().k1, once);
  EXPECT_TRUE(observe(6, 11));
  EXPECT_NE(lens.estimate().k1, once);
}

/// A drive with depths through images of k1, which are taken for undistorted. The depths are those
/// of the pixels: on a street, a point that appears nearer to the border seems to be nearer.
SlidingWindow distorted_drive(double k1, bool depth, bool depth_of_pixel) {
  Random random(4);
  test::WindowWorldOptions drive;
  drive.stereo = depth;
  drive.sigma_px = 0.3;
  test::WindowWorld world = test::make_window_world(drive, random);
  Camera bent = world.camera;
  bent.distortion = Distortion::kRadialTangential;
  bent.coefficients = {k1};
  for (WindowObservation& o : world.observations) {
    const Eigen::Vector2d px = *bent.project(*world.camera.unproject(o.px));
    const auto radius = [&](const Eigen::Vector2d& p) {
      return (p - Eigen::Vector2d(world.camera.cx, world.camera.cy)).norm();
    };
    if (depth_of_pixel && o.inverse_depth) *o.inverse_depth *= radius(px) / radius(o.px);
    o.px = px;
  }
  SlidingWindow window({}, world.camera);
  for (std::int64_t id = 0; id < drive.keyframes; ++id) {
    window.add_keyframe(KeyframeId(id), world.T_map_cam[static_cast<std::size_t>(id)]);
    test::add_view(window, world, KeyframeId(id), 0, random);
  }
  EXPECT_TRUE(window.optimize().outcome);
  return window;
}

TEST(LensEstimator, FindsALargeDistortion) {
  for (const bool depth : {false, true})
    for (const double k1 : {-0.08, 0.05}) {
      LensEstimator lens;
      lens.observe(distorted_drive(k1, depth, false));
      EXPECT_NEAR(lens.estimate().k1, k1, 0.03 * std::abs(k1)) << depth;
    }
}

TEST(LensEstimator, DepthsOfDistortedPixelsDoNotHideIt) {
  for (const double k1 : {-0.08, 0.05}) {
    LensEstimator lens;
    lens.observe(distorted_drive(k1, true, true));
    EXPECT_NEAR(lens.estimate().k1, k1, 0.15 * std::abs(k1));
  }
}

Calibration monocular() {
  Calibration calibration;
  calibration.camera.width = 160;
  calibration.camera.height = 120;
  calibration.camera.fx = calibration.camera.fy = 130;
  calibration.camera.cx = 80;
  calibration.camera.cy = 60;
  return calibration;
}

TEST(LensCorrection, LeavesEverythingAsItIsUntilSomethingIsFound) {
  LensCorrection lens(monocular());
  Frame frame;
  frame.image = Image(120, 160, CV_8UC1, cv::Scalar(7));
  const Image before = frame.image;
  lens.apply(frame);
  EXPECT_EQ(frame.image.data, before.data);
  EXPECT_EQ(lens.calibration().camera.fx, 130);
}

/// An estimate that several stretches agree on.
LensDistortion seen(double k1, double sigma_k1) { return {k1, sigma_k1, 0.2, 3}; }

TEST(LensCorrection, IsMadeOnceAndRefinedOnce) {
  const LensOptions options;
  EXPECT_EQ(change_of_k1(0, seen(-0.03, 0.005), 0, options), -0.03);
  EXPECT_FALSE(change_of_k1(0, seen(-0.03, 0.007), 0, options));
  EXPECT_EQ(change_of_k1(-0.03, seen(-0.009, 0.005), 1, options), -0.009);
  EXPECT_FALSE(change_of_k1(-0.03, seen(-0.015, 0.007), 1, options));  // less sure than at first
  EXPECT_FALSE(change_of_k1(-0.03, seen(-0.007, 0.005), 1, options));  // may be noise
  EXPECT_FALSE(change_of_k1(-0.03, seen(-0.002, 0.001), 1, options));  // less than a tenth of it
  EXPECT_FALSE(change_of_k1(-0.035, seen(-0.03, 0.003), 2, options));
}

TEST(LensCorrection, IsUndoneByWhatContradictsIt) {
  LensOptions options;
  EXPECT_EQ(change_of_k1(-0.03, seen(0.025, 0.006), 1, options), 0.03);
  EXPECT_FALSE(change_of_k1(-0.03, seen(0.025, 0.007), 1, options));  // that is not sure
  EXPECT_FALSE(change_of_k1(0, seen(0.025, 0.004), 1, options));      // nothing to undo
  EXPECT_FALSE(change_of_k1(0, seen(0.025, 0.004), 2, options));      // once
  options.enabled = false;
  EXPECT_FALSE(change_of_k1(-0.03, seen(0.025, 0.004), 1, options));
  LensCorrection lens(monocular());
  lens.add(-0.03);
  lens.add(0.03);
  EXPECT_EQ(lens.calibration().camera.fx, 130);
}

TEST(LensCorrection, NamesTheDistortionThatIsLeft) {
  const DataNote none = distortion_note(0, seen(0.02, 0.001));
  EXPECT_EQ(none.cause, NoteCause::kDistortion);
  EXPECT_EQ(none.text,
            "the images show radial distortion, k1 = 0.0200 +- 0.0010; none of it was removed");
  EXPECT_FALSE(none.advice.empty());
  EXPECT_EQ(distortion_note(0.03, seen(-0.01, 0.001)).text,
            "the images show radial distortion, k1 = 0.0200 +- 0.0010; 0.0300 of it was removed");
}

TEST(LensCorrection, MovesABrightSpotToWhereAnIdealCameraShowsIt) {
  Camera distorted = monocular().camera;
  distorted.distortion = Distortion::kRadialTangential;
  distorted.coefficients = {-0.1};
  const Eigen::Vector3d p_cam(0.4, -0.3, 1);
  const Eigen::Vector2d px = *distorted.project(p_cam);
  Frame frame;
  frame.image = Image::zeros(120, 160, CV_8UC1);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x)
      frame.image.at<uchar>(y, x) =
          cv::saturate_cast<uchar>(255 * std::exp(-(Eigen::Vector2d(x, y) - px).squaredNorm() / 8));
  LensCorrection lens(monocular());
  lens.add(-0.06);
  lens.add(-0.04);
  EXPECT_NEAR(lens.k1(), -0.1, 1e-12);
  lens.apply(frame);
  const Eigen::Vector2d expected = *lens.calibration().camera.project(p_cam);
  double weight = 0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (int y = 0; y < frame.image.rows; ++y)
    for (int x = 0; x < frame.image.cols; ++x) {
      weight += frame.image.at<uchar>(y, x);
      mean += frame.image.at<uchar>(y, x) * Eigen::Vector2d(x, y);
    }
  EXPECT_LT((mean / weight - expected).norm(), 0.1);
  EXPECT_GT((px - expected).norm(), 1);
}

TEST(LensCorrection, AMaskOfCorrectedImagesIsThatOfTheGivenOnes) {
  Calibration calibration;
  calibration.camera = {
      .width = 320, .height = 240, .fx = 250, .fy = 250, .cx = 159.5, .cy = 119.5};
  LensCorrection lens(calibration);
  Image mask(240, 320, CV_8UC1, cv::Scalar(255));
  mask(cv::Rect(30, 40, 60, 50)).setTo(0);
  EXPECT_EQ(lens.mask_as_taken(mask).data, mask.data);  // nothing is corrected
  lens.add(-0.1);
  Frame frame;
  frame.image = mask;
  frame.mask = lens.mask_as_taken(mask);
  EXPECT_GT(cv::countNonZero(frame.mask != mask), 150);  // the lens has moved it
  lens.apply(frame);
  EXPECT_LT(
      cv::countNonZero(frame.mask(cv::Rect(20, 30, 80, 70)) != mask(cv::Rect(20, 30, 80, 70))),
      150);  // along its outline
}

}  // namespace lens_test
}  // namespace placegraph
