#include <gtest/gtest.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/pipeline/overlays/lens_spots.h>

#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace lens_spots_test {

using test::StreetDataset;

constexpr int kImages = 40;

/// The share of light that a dirty lens lets through.
cv::Mat1f lens(Random& random, int spots, int width, int height) {
  cv::Mat1f clear(height, width, 1.F);
  for (int i = 0; i < spots; ++i) {
    const cv::Point centre(static_cast<int>(random.uniform(0, width)),
                           static_cast<int>(random.uniform(0, height)));
    cv::circle(clear, centre, static_cast<int>(random.uniform(width / 60.0, width / 25.0)),
               cv::Scalar(random.uniform(0.1, 0.5)), cv::FILLED);
  }
  cv::GaussianBlur(clear, clear, {}, width / 200.0);
  return clear;
}

LensSpots watched(const StreetDataset& drive, const cv::Mat1f& clear) {
  LensSpots spots;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    cv::Mat1f light;
    drive.frame(i, Sensor::kMono).image.convertTo(light, CV_32F);
    Image seen;
    cv::Mat(light.mul(clear)).convertTo(seen, CV_8U);
    spots.add(seen);
  }
  return spots;
}

/// A drive that turns to both sides, so that the world moves everywhere in the image.
SE3 winding(int i) {
  return test::pose({0, 0.15 * std::sin(0.3 * i), 0}, {0, -test::kStreetHeight_m, 0.25 * i});
}

const StreetDataset& drive() {
  static const StreetDataset street(kImages, 0, 0, false, winding);
  return street;
}

TEST(LensSpots, AreFoundWhereTheyAre) {
  const Camera camera = test::street_camera();
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed, 0);
    const cv::Mat1f clear = lens(random, 25, camera.width, camera.height);
    const Image region = watched(drive(), clear).region();
    ASSERT_FALSE(region.empty());
    Image dirty = clear < 0.7F, beside = clear > 0.95F;
    // Most of what is masked is dirty, or next to it.
    cv::dilate(dirty, dirty, Image::ones(15, 15, CV_8UC1));
    EXPECT_LT(cv::countNonZero(region & ~dirty), 0.25 * cv::countNonZero(region));
    EXPECT_GT(cv::countNonZero(region & (clear < 0.6F)),
              0.3 * cv::countNonZero(clear < 0.6F));
  }
}

TEST(LensSpots, ACleanLensHasNone) {
  const Camera camera = test::street_camera();
  EXPECT_TRUE(watched(drive(), cv::Mat1f(camera.height, camera.width, 1.F)).region().empty());
  // Nor does one that is darker towards its border.
  cv::Mat1f vignette(camera.height, camera.width);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const double r = std::hypot(u - camera.width / 2.0, v - camera.height / 2.0) / camera.width;
      vignette(v, u) = static_cast<float>(1 / (1 + 4 * r * r));
    }
  EXPECT_TRUE(watched(drive(), vignette).region().empty());
}

// What stands still because the camera does is no spot.
TEST(LensSpots, TheWorldOfACameraAtRestHasNone) {
  LensSpots spots;
  const Frame frame = drive().frame(3, Sensor::kMono);
  for (int i = 0; i < kImages; ++i) spots.add(frame.image);
  EXPECT_TRUE(spots.region().empty());
}

TEST(LensSpots, AreJudgedOnlyAfterEnoughImages) {
  const Camera camera = test::street_camera();
  Random random(2, 0);
  const cv::Mat1f clear = lens(random, 25, camera.width, camera.height);
  EXPECT_TRUE(watched(StreetDataset(20, 0, 0, false, winding), clear).region().empty());
}

}  // namespace lens_spots_test
}  // namespace placegraph
