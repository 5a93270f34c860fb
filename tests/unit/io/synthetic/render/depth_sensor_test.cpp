#include <gtest/gtest.h>
#include <placegraph/io/synthetic/render/depth_sensor.h>

#include <cmath>

namespace placegraph::synthetic {
namespace depth_sensor_test {

constexpr int kWidth = 320, kHeight = 240;
constexpr int kEdge = 160;  ///< first column of the far surface

View view() {
  View out;
  out.camera.width = kWidth;
  out.camera.height = kHeight;
  out.camera.fx = out.camera.fy = 260;
  out.camera.cx = 159.5;
  out.camera.cy = 119.5;
  return out;
}

/// A slanted wall on the left, 1.5 m away in the middle, and one at 3 m on the right.
Image two_walls() {
  Image iz(kHeight, kWidth, CV_32FC1);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      iz.at<float>(v, u) = u < kEdge ? 1 / 1.5F + 0.001F * static_cast<float>(u - kEdge) : 1 / 3.0F;
  return iz;
}

Image measure(const DepthSensor& sensor, std::uint32_t seed = 5) {
  return measure_depth(two_walls(), view(), sensor, seed, 9);
}

/// Calls fn(column, exact inverse depth, measured inverse depth) where there is a measurement.
template <class Fn>
void compare(const Image& depth, const Fn& fn) {
  const Image exact = two_walls();
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      if (depth.at<float>(v, u) > 0)
        fn(u, static_cast<double>(exact.at<float>(v, u)), 1.0 / depth.at<float>(v, u));
}

TEST(DepthSensor, WithoutDefectsIsExact) {
  int count = 0;
  compare(measure({}), [&](int, double exact, double measured) {
    ++count;
    ASSERT_NEAR(measured, exact, 1e-7);
  });
  EXPECT_EQ(count, kWidth * kHeight);
}

TEST(DepthSensor, QuantizationPutsInverseDepthOnAGrid) {
  constexpr double kStep = 0.00285;
  DepthSensor sensor;
  sensor.step = kStep;
  compare(measure(sensor), [&](int, double exact, double measured) {
    const double steps = measured / kStep;
    ASSERT_NEAR(steps, std::round(steps), 1e-4);
    ASSERT_LE(std::abs(measured - exact), 0.5001 * kStep);
  });
}

TEST(DepthSensor, NoiseHasItsSigmaInInverseDepth) {
  constexpr double kNoise = 0.0014;
  DepthSensor sensor;
  sensor.noise = kNoise;
  double sum = 0, squares = 0;
  compare(measure(sensor), [&](int, double exact, double measured) {
    sum += measured - exact;
    squares += (measured - exact) * (measured - exact);
  });
  const double n = kWidth * kHeight;
  EXPECT_NEAR(sum / n, 0, 4 * kNoise / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), kNoise, 0.02 * kNoise);
}

TEST(DepthSensor, ScaleMultipliesDepth) {
  DepthSensor sensor;
  sensor.scale = 1.01;
  compare(measure(sensor),
          [&](int, double exact, double measured) { ASSERT_NEAR(exact / measured, 1.01, 1e-5); });
}

TEST(DepthSensor, HolesAreTheStatedShareInBlobsAndBesideEdges) {
  DepthSensor sensor;
  sensor.holes = 0.1;
  const Image depth = measure(sensor);
  int holes = 0, beside = 0, neighbours = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 1; u < kWidth; ++u) {
      if (depth.at<float>(v, u) > 0) continue;
      ++holes;
      beside += u >= kEdge && u < kEdge + 4;
      neighbours += depth.at<float>(v, u - 1) == 0;
    }
  }
  EXPECT_NEAR(holes, 0.1 * kWidth * kHeight, 0.005 * kWidth * kHeight);
  EXPECT_GT(beside, 0.4 * 4 * kHeight);  // far more than a tenth of the four columns
  EXPECT_GT(neighbours, 0.6 * holes);    // of single pixels it would be a tenth
  compare(depth, [&](int, double exact, double measured) { ASSERT_NEAR(measured, exact, 1e-7); });
}

TEST(DepthSensor, PatchesWithoutDepthStayOnTheirSurface) {
  // A camera that steps aside sees the patches shifted by its parallax.
  Image wall(kHeight, kWidth, CV_32FC1, cv::Scalar(0.5));
  DepthSensor sensor;
  sensor.holes = 0.2;
  View here = view(), there = view();
  there.T_scene_cam = SE3(SO3(), Eigen::Vector3d(40 / (0.5 * 260), 0, 0));
  const Image a = measure_depth(wall, here, sensor, 1, 9),
              b = measure_depth(wall, there, sensor, 2, 9);
  int equal = 0, compared = 0;
  for (int v = 0; v < kHeight; ++v)
    for (int u = 40; u < kWidth; ++u) {
      if (a.at<float>(v, u) > 0) continue;
      ++compared;
      equal += b.at<float>(v, u - 40) == 0;
    }
  EXPECT_GT(compared, 0);
  EXPECT_GT(equal, 0.7 * compared);
}

TEST(DepthSensor, FlyingPixelsLieBetweenTheSidesOfAnEdge) {
  DepthSensor sensor;
  sensor.flying_pixels = 0.5;
  int flying = 0;
  compare(measure(sensor), [&](int u, double exact, double measured) {
    if (std::abs(measured - exact) < 1e-6) return;
    ++flying;
    ASSERT_GE(u, kEdge - 2);
    ASSERT_LT(u, kEdge + 2);
    ASSERT_GT(measured, 1 / 3.0 - 1e-6);
    ASSERT_LT(measured, 1 / 1.5 + 1e-6);
  });
  EXPECT_NEAR(flying, 0.5 * 4 * kHeight, 0.08 * 4 * kHeight);
}

TEST(DepthSensor, ASlantedPlaneHasNoEdge) {
  Image floor(kHeight, kWidth, CV_32FC1);
  for (int v = 0; v < kHeight; ++v)
    floor.row(v).setTo(std::max(0.0F, 0.006F * static_cast<float>(v - 100)));
  DepthSensor sensor;
  sensor.flying_pixels = 1;
  const Image depth = measure_depth(floor, view(), sensor, 5, 9);
  for (int v = 101; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      ASSERT_NEAR(1 / depth.at<float>(v, u), floor.at<float>(v, u), 1e-6);
}

}  // namespace depth_sensor_test
}  // namespace placegraph::synthetic
