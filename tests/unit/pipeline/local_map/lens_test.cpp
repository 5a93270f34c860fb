#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/internal/lens_correction.h>
#include <placegraph/pipeline/internal/local_map/lens_estimator.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace {

/// Of a window that says k1, to `sigma`.
DistortionEvidence window_of(double k1, double sigma) {
  const double information = 1 / (sigma * sigma);
  return {-k1 * information, information, 1000};
}

TEST(LensEstimator, IsTheWeightedMeanOfItsWindows) {
  LensEstimator lens;
  EXPECT_EQ(lens.k1(), 0);
  lens.add(window_of(0.02, 0.001));
  lens.add(window_of(0.03, 0.002));
  EXPECT_NEAR(lens.k1(), (4 * 0.02 + 0.03) / 5, 1e-12);
  lens.add({});  // a window that saw nothing
  EXPECT_NEAR(lens.k1(), (4 * 0.02 + 0.03) / 5, 1e-12);
}

TEST(LensEstimator, KnowsItsDeviationFromFourWindowsOfLikeWeightOn) {
  LensEstimator lens;
  for (int i = 0; i < 3; ++i) lens.add(window_of(0.02, 0.001));
  EXPECT_TRUE(std::isinf(lens.sigma_k1()));
  lens.add(window_of(0.02, 0.01));  // of a hundredth of their weight
  EXPECT_TRUE(std::isinf(lens.sigma_k1()));
  lens.add(window_of(0.02, 0.001));
  EXPECT_NEAR(lens.sigma_k1(), 0.0005, 1e-5);
}

TEST(LensEstimator, AWindowThatSawNothingDoesNotCount) {
  LensEstimator lens;
  for (const double k1 : {0.01, 0.03, 0.01, 0.03, 0.01}) lens.add(window_of(k1, 0.001));
  const double sigma = lens.sigma_k1();
  lens.add({});
  EXPECT_EQ(lens.sigma_k1(), sigma);
}

TEST(LensEstimator, ADistortionThatHardlyMovesTheTracksIsNoneHoweverSure) {
  LensOptions options;
  LensEstimator lens;
  for (int i = 0; i < 6; ++i) lens.add({-0.02 * 1e6, 1e6, 1'000'000'000});
  EXPECT_LT(lens.effect(), options.min_effect);
  EXPECT_GT(lens.k1(), options.min_sigmas * lens.sigma_k1());
  EXPECT_FALSE(is_distorted(lens.estimate(), options));
  options.min_effect = 0;
  EXPECT_TRUE(is_distorted(lens.estimate(), options));
}

TEST(LensEstimator, HearsWindowsThatShareNoKeyframe) {
  Random random(3);
  test::WindowWorldOptions drive;
  drive.keyframes = 12;
  drive.noise_px = 0.3;
  const test::WindowWorld world = test::make_window_world(drive, random);
  const auto observe = [&](LensEstimator& lens, std::int64_t first, std::int64_t last) {
    SlidingWindow window({}, world.camera);
    for (std::int64_t id = first; id <= last; ++id) {
      window.add_keyframe(KeyframeId(id), world.T_map_cam[static_cast<std::size_t>(id)]);
      test::add_view(window, world, KeyframeId(id), 0, random);
    }
    lens.observe(window);
  };
  /// What the windows heard weigh beside one that is known.
  const auto weighed = [](LensEstimator lens) {
    lens.add(window_of(0.5, 0.01));
    return lens.k1();
  };
  LensEstimator lens;
  observe(lens, 0, 5);
  const double once = weighed(lens);
  EXPECT_LT(std::abs(once - 0.5), 0.5);
  EXPECT_NE(once, 0.5);
  observe(lens, 0, 5);
  EXPECT_EQ(weighed(lens), once);
  observe(lens, 5, 10);  // one keyframe in common
  EXPECT_EQ(weighed(lens), once);
  observe(lens, 6, 11);
  EXPECT_NE(weighed(lens), once);
}

TEST(LensEstimator, WindowsThatContradictEachOtherWidenIt) {
  LensEstimator lens;
  for (const double k1 : {0.01, 0.03, 0.01, 0.03, 0.01, 0.03}) lens.add(window_of(k1, 0.001));
  EXPECT_NEAR(lens.sigma_k1(), std::sqrt(6 * 1e-4 / 5 / 6), 1e-6);
}

TEST(LensEstimator, CallsALensDistortedByProofAndEffect) {
  LensOptions options;
  LensEstimator clear, small, unsure;
  for (int i = 0; i < 6; ++i) {
    clear.add(window_of(0.02 + 1e-3 * (i % 2), 0.003));
    small.add({-0.02 * 200, 200, 1000});  // 0.02 of it moves the tracks by 0.009 deviations
    unsure.add(window_of(i % 2 ? 0.1 : -0.06, 0.003));
  }
  EXPECT_NEAR(clear.effect(), 0.0205 / 0.003 / std::sqrt(1000), 1e-9);
  EXPECT_TRUE(is_distorted(clear.estimate(), options));
  EXPECT_FALSE(is_distorted(small.estimate(), options));
  EXPECT_FALSE(is_distorted(unsure.estimate(), options));
  options.enabled = false;
  EXPECT_FALSE(is_distorted(clear.estimate(), options));
  options.min_sigmas = -1;
  EXPECT_THROW(options.check(), ArgumentError);
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

}  // namespace
}  // namespace placegraph
