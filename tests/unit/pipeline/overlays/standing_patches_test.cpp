#include <gtest/gtest.h>
#include <placegraph/pipeline/overlays/standing_patches.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/scenes/scene.h"

namespace placegraph {
namespace standing_patches_test {

using namespace test;

const Camera kCamera = pinhole(640, 480, 500);
const cv::Rect kFixed(200, 150, 200, 150);
constexpr int kComparisons = 20;

/// A wide texture with structure of some pixels.
Image texture(int width, int height, int seed) {
  Image noise(height, width, CV_8UC1);
  cv::RNG random(seed);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(noise, noise, {}, 2);
  cv::normalize(noise, noise, 0, 255, cv::NORM_MINMAX);
  return noise;
}

/// Image `i` of a camera that moves by `step_px` a comparison, with something fixed to it.
Image moving_image(int i, int step_px) {
  static const Image world = texture(2000, kCamera.height, 1);
  static const Image fixed = texture(kFixed.width, kFixed.height, 2);
  Image image = world(cv::Rect(step_px * i, 0, kCamera.width, kCamera.height)).clone();
  fixed.copyTo(image(kFixed));
  return image;
}

/// The motion of a camera that rotates.
ImageMotion rotation(double angle) {
  Random random(3);
  std::vector<Eigen::Vector2d> ref, cur;
  while (ref.size() < 100) {
    const Eigen::Vector2d px(random.uniform(0, 640), random.uniform(0, 480));
    const auto moved = kCamera.project(SO3::exp({0, -angle, 0}) * *kCamera.unproject(px));
    if (!moved) continue;
    ref.push_back(px);
    cur.emplace_back(moved->x() + random.normal(0, 0.1), moved->y() + random.normal(0, 0.1));
  }
  return ImageMotion::estimate(kCamera, ref, cur, random).value();
}

TEST(StandingPatches, AreSuspectWhereTheRestOfTheImageMoves) {
  StandingPatches patches(kCamera);
  for (int i = 0; i < kComparisons; ++i) patches.compare(moving_image(i, 5), {});
  EXPECT_TRUE(patches.suspects());
  const Image elsewhere = patches.elsewhere();
  EXPECT_LT(cv::countNonZero(elsewhere(kFixed)), 0.4 * kFixed.area());
  EXPECT_GT(cv::countNonZero(elsewhere), 0.8 * (640 * 480 - kFixed.area()));
}

TEST(StandingPatches, AreNotSuspectWhenTheCameraRestsOrNothingIsFixed) {
  StandingPatches at_rest(kCamera), clean(kCamera);
  const Image world = texture(2000, kCamera.height, 1);
  for (int i = 0; i < kComparisons; ++i) {
    at_rest.compare(moving_image(0, 5), {});
    clean.compare(world(cv::Rect(5 * i, 0, kCamera.width, kCamera.height)), {});
  }
  EXPECT_FALSE(at_rest.suspects());
  EXPECT_FALSE(clean.suspects());
}

TEST(StandingPatches, StandStillWhateverTheExposure) {
  StandingPatches patches(kCamera);
  for (int i = 0; i < kComparisons; ++i) {
    Image image;
    moving_image(i, 5).convertTo(image, CV_8U, 0.5 + 0.02 * i, 10 + i);
    patches.compare(image, {});
  }
  EXPECT_TRUE(patches.suspects());
}

TEST(StandingPatches, AreNotTakenWhereTheMaskForbidsThem) {
  StandingPatches patches(kCamera);
  Image mask(kCamera.height, kCamera.width, CV_8UC1, cv::Scalar(255));
  mask(kFixed).setTo(0);
  for (int i = 0; i < kComparisons; ++i) patches.compare(moving_image(i, 5), mask);
  EXPECT_FALSE(patches.suspects());
}

TEST(StandingPatches, MustStandForLongWhereOthersMoved) {
  StandingPatches patches(kCamera);
  const Image world = texture(2000, kCamera.height, 1);
  for (int i = 0; i < 2 * kComparisons; ++i)
    patches.compare(world(cv::Rect(5 * i, 0, kCamera.width, kCamera.height)), {});
  int comparisons = 0;
  for (; comparisons < 4 * kComparisons && !patches.suspects(); ++comparisons)
    patches.compare(moving_image(comparisons, 5), {});
  EXPECT_GT(comparisons, 10);
  EXPECT_TRUE(patches.suspects());
}

TEST(StandingPatches, AreProvenByRotationsSinceTheyWereTaken) {
  StandingPatches patches(kCamera);
  for (int i = 0; i < kComparisons; ++i) patches.compare(moving_image(i, 5), {});
  EXPECT_FALSE(patches.judge(rotation(0.02), 0));               // before they were taken
  EXPECT_FALSE(patches.judge(rotation(0.0005), kComparisons));  // a fourth of a pixel
  EXPECT_TRUE(patches.judge(rotation(0.02), kComparisons));
  EXPECT_EQ(cv::countNonZero(patches.proven_cells()), 0);  // once is not enough
  EXPECT_TRUE(patches.judge(rotation(0.02), kComparisons));
  Image cells;
  cv::resize(patches.proven_cells(), cells, {640, 480}, 0, 0, cv::INTER_NEAREST);
  EXPECT_GT(cv::countNonZero(cells(kFixed)), 0.6 * kFixed.area());
  cells(kFixed).setTo(0);
  EXPECT_LT(cv::countNonZero(cells), 0.4 * kFixed.area());
}

}  // namespace standing_patches_test
}  // namespace placegraph
