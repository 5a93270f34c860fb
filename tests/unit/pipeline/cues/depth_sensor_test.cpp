#include <gtest/gtest.h>
#include <placegraph/pipeline/cues/depth_sensor.h>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace depth_sensor_test {

using namespace test;

const StreetDataset& street_of(bool with_depth) {
  static const StreetDataset stereo(1), depth(1, 0, 0, true);
  return with_depth ? depth : stereo;
}
DepthSensor sensor_of(Sensor sensor) {
  return DepthSensor(street_of(sensor == Sensor::kRgbd).calibration(sensor), {});
}

/// Pixels on the house fronts and the end wall. The road is too slanted for patches of one
/// disparity: they err by several deviations there.
std::vector<Eigen::Vector2f> pixels() {
  std::vector<Eigen::Vector2f> px;
  for (int v = 60; v < 180; v += 20)
    for (int u = 40; u < 420; u += 20)
      px.emplace_back(static_cast<float>(u), static_cast<float>(v));
  return px;
}
double true_depth(const Eigen::Vector2f& px) {
  static const Image depth = street_of(true).frame(0, Sensor::kRgbd).depth;
  return depth.at<float>(static_cast<int>(px.y()), static_cast<int>(px.x()));
}

TEST(DepthSensor, StereoMeasuresInverseDepthsToTheirDeviation) {
  const Frame frame = street_of(false).frame(0, Sensor::kStereo);
  const auto depths = sensor_of(Sensor::kStereo).measure(frame, {}, pixels());
  int found = 0, within = 0;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (!depths[i]) continue;
    ++found;
    EXPECT_NEAR(depths[i]->sigma * street_camera().fx * kStreetBaseline_m,
                StereoMatcherOptions().sigma_disparity_px, 1e-9);
    within += std::abs(depths[i]->value - 1 / true_depth(pixels()[i])) < 3 * depths[i]->sigma;
    const Eigen::Vector3d ray = *street_camera().unproject(pixels()[i].cast<double>());
    EXPECT_LT((depths[i]->ray_cam - ray).norm(), 1e-6);
  }
  EXPECT_GT(found, 60);
  EXPECT_GT(within, 0.95 * found);
}

TEST(DepthSensor, ARectificationErrorIsTakenOffTheDisparity) {
  const Frame frame = street_of(false).frame(0, Sensor::kStereo);
  const RectificationError error{0.5, 0, 0};
  const auto plain = sensor_of(Sensor::kStereo).measure(frame, {}, pixels());
  const auto corrected = sensor_of(Sensor::kStereo).measure(frame, error, pixels());
  const double px_per_inverse = street_camera().fx * kStreetBaseline_m;
  for (std::size_t i = 0; i < plain.size(); ++i)
    if (plain[i] && corrected[i]) {
      EXPECT_NEAR((plain[i]->value - corrected[i]->value) * px_per_inverse, 0.5, 1e-9);
    }
}

TEST(DepthSensor, ADisparityIsExpectedWhereThePointIs) {
  const DepthSensor stereo = sensor_of(Sensor::kStereo);
  const RectificationError error{0.2, 0.3, -0.1};
  const Eigen::Vector3d point(1, -2, 8);
  EXPECT_NEAR(*stereo.disparity_px(point, error),
              330 * 0.5 / 8 + 0.2 + 0.3 * 1 / 8.0 - 0.1 * -2 / 8.0, 1e-12);
  EXPECT_EQ(stereo.disparity_px({1, -2, -8}, error), std::nullopt);
  EXPECT_EQ(sensor_of(Sensor::kMono).disparity_px(point, error), std::nullopt);
}

TEST(DepthSensor, InverseDepthsAreExpectedAtTheDisparitiesOfTheirPoints) {
  const DepthSensor sensor = sensor_of(Sensor::kStereo);
  const RectificationError error{0.5, -0.2, 0.1};
  const std::vector<Eigen::Vector2f> px = {{100, 80}, {300, 120}, {200, 60}};
  const auto expected = sensor.disparities_px(px, {0.1, 0.04, -0.01}, error);
  ASSERT_EQ(expected.size(), 3u);
  for (std::size_t i = 0; i < 2; ++i) {
    const double inverse_depth = i == 0 ? 0.1 : 0.04;
    const Eigen::Vector3d ray = *street_camera().unproject(px[i].cast<double>());
    EXPECT_NEAR(*expected[i], *sensor.disparity_px(ray / inverse_depth, error), 1e-6);
  }
  EXPECT_LT(*expected[2], *sensor.disparities_px({px[2]}, {0}, error)[0]);  // beyond infinity
  EXPECT_TRUE(sensor_of(Sensor::kRgbd).disparities_px(px, {0.1, 0.04, 0.02}, error).empty());
  EXPECT_TRUE(sensor.disparities_px(px, {}, error).empty());
}

TEST(DepthSensor, ADepthImageIsLookedUp) {
  const Frame frame = street_of(true).frame(0, Sensor::kRgbd);
  const auto depths = sensor_of(Sensor::kRgbd).measure(frame, {}, pixels());
  int found = 0;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (!depths[i]) continue;
    ++found;
    EXPECT_NEAR(1 / depths[i]->value, true_depth(pixels()[i]), 0.03 * true_depth(pixels()[i]));
    EXPECT_EQ(depths[i]->sigma, 0.005);
  }
  EXPECT_GT(found, 50);  // of 114: elsewhere fronts recede by more than max_spread beside the pixel
}

TEST(DepthSensor, AMonocularCameraMeasuresNone) {
  const Frame frame = street_of(false).frame(0, Sensor::kMono);
  const auto depths = sensor_of(Sensor::kMono).measure(frame, {}, pixels());
  ASSERT_EQ(depths.size(), pixels().size());
  for (const auto& depth : depths) EXPECT_FALSE(depth);
}

}  // namespace depth_sensor_test
}  // namespace placegraph
