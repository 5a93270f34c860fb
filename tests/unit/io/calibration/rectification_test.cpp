#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/calibration/rectification.h>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace placegraph {
namespace rectification_test {

Camera radial_tangential() {
  return {752,
          480,
          458.654,
          457.296,
          367.215,
          248.375,
          Distortion::kRadialTangential,
          {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0}};
}

Camera equidistant() {
  return {
      640, 480, 290, 291, 322, 238, Distortion::kEquidistant, {0.0035, 0.0007, -0.002, 0.0002, 0}};
}

/// Where the remap looks in the raw image for a pixel of the new one, between the pixels too.
Eigen::Vector2d raw_pixel(const Remap& remap, const Eigen::Vector2d& px) {
  const int u = static_cast<int>(px.x()), v = static_cast<int>(px.y());
  const double a = px.x() - u, b = px.y() - v;
  const auto sample = [&](const Image& map) {
    return (1 - b) * ((1 - a) * map.at<float>(v, u) + a * map.at<float>(v, u + 1)) +
           b * ((1 - a) * map.at<float>(v + 1, u) + a * map.at<float>(v + 1, u + 1));
  };
  return {sample(remap.map_x), sample(remap.map_y)};
}

/// Float maps hold about 1e-4 px; bilinear interpolation of the map itself stays below 1e-2.
constexpr double kMapTolerance_px = 1e-2;

TEST(UndistortCamera, SeesEveryPointWhereTheRawCameraSeesIt) {
  for (const Camera& raw : {radial_tangential(), equidistant()}) {
    const UndistortedCamera undistorted = undistort_camera(raw);
    EXPECT_EQ(undistorted.camera.distortion, Distortion::kNone);
    Random random(3);
    int seen = 0;
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d p_cam(random.uniform(-2, 2), random.uniform(-1.5, 1.5), 3);
      const auto ideal = undistorted.camera.project(p_cam);
      if (!ideal || !undistorted.camera.contains(*ideal, 2)) continue;
      const auto distorted = raw.project(p_cam);
      ASSERT_TRUE(distorted);
      EXPECT_LT((raw_pixel(undistorted.remap, *ideal) - *distorted).norm(), kMapTolerance_px);
      ++seen;
    }
    EXPECT_GT(seen, 50);
  }
}

TEST(UndistortCamera, LeavesNoPixelMoreThanABorderOutsideTheRawImage) {
  for (const Camera& raw : {radial_tangential(), equidistant()}) {
    const UndistortedCamera undistorted = undistort_camera(raw);
    double min_x, max_x, min_y, max_y;
    cv::minMaxLoc(undistorted.remap.map_x, &min_x, &max_x);
    cv::minMaxLoc(undistorted.remap.map_y, &min_y, &max_y);
    // OpenCV inscribes the rectangle to about a pixel.
    EXPECT_GT(min_x, -1.5);
    EXPECT_GT(min_y, -1.5);
    EXPECT_LT(max_x, raw.width + 0.5);
    EXPECT_LT(max_y, raw.height + 0.5);
  }
}

TEST(UndistortCamera, DividesByTheDenominatorOfARationalLens) {
  RawCamera raw(radial_tangential());
  set_radial_tangential({0.4, 0.05, 1e-3, -2e-3, 0.02, 0.6, 0.1, 0.01}, raw);
  const UndistortedCamera undistorted = undistort_camera(raw);
  const Camera& camera = raw.camera;
  for (const Eigen::Vector2d& px : {Eigen::Vector2d(100, 80), Eigen::Vector2d(600, 400)}) {
    const Eigen::Vector3d n = *undistorted.camera.unproject(px);
    const double x = n.x(), y = n.y(), r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2;
    const double radial =
        (1 + 0.4 * r2 + 0.05 * r4 + 0.02 * r6) / (1 + 0.6 * r2 + 0.1 * r4 + 0.01 * r6);
    const Eigen::Vector2d distorted(x * radial + 2e-3 * x * y - 2e-3 * (r2 + 2 * x * x),
                                    y * radial + 1e-3 * (r2 + 2 * y * y) - 4e-3 * x * y);
    const Eigen::Vector2d expected(camera.fx * distorted.x() + camera.cx,
                                   camera.fy * distorted.y() + camera.cy);
    EXPECT_LT((raw_pixel(undistorted.remap, px) - expected).norm(), kMapTolerance_px);
  }
}

TEST(RawCamera, HasNoRaysWhereARationalLensIsNotMonotonic) {
  RawCamera raw(radial_tangential());
  // r / (1 + r^2) grows up to r = 1, where it is one half.
  set_radial_tangential({0, 0, 0, 0, 0, 1, 0, 0}, raw);
  EXPECT_NEAR(raw.rational_reach(), 0.5, 1e-5);
  // The denominator vanishes at r = 1: everything lies nearer.
  set_radial_tangential({0, 0, 0, 0, 0, -1, 0, 0}, raw);
  EXPECT_GT(raw.rational_reach(), 100);
}

TEST(UndistortCamera, IsTheIdentityWithoutDistortion) {
  const Camera camera{64, 48, 50, 50, 32, 24, Distortion::kNone, {}};
  const UndistortedCamera undistorted = undistort_camera(camera);
  EXPECT_TRUE(undistorted.remap.is_identity());
  EXPECT_EQ(undistorted.camera.fx, 50);
  const Image image(48, 64, CV_8UC1, cv::Scalar(7));
  EXPECT_EQ(undistorted.remap.bilinear(image).data, image.data);
  EXPECT_EQ(undistorted.remap.nearest(image).data, image.data);
}

TEST(RectifyStereo, PutsEveryPointOnTheSameRowOfBothCamerasAtTheDisparityOfItsDepth) {
  for (const bool fisheye : {false, true}) {
    const Camera left = fisheye ? equidistant() : radial_tangential();
    Camera right = left;
    right.fx += 1.5, right.cy += 4;
    Vector6d xi;
    xi << 0.11, 0.003, -0.002, 0.01, -0.02, 0.008;  // nearly parallel eyes
    const SE3 T_left_right = SE3::exp(xi);
    const RectifiedStereo stereo = rectify_stereo(left, right, T_left_right);
    EXPECT_NEAR(stereo.baseline_m, T_left_right.translation().norm(), 1e-9);

    Random random(5);
    int seen = 0;
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector3d p_left(random.uniform(-2, 2), random.uniform(-1.5, 1.5),
                                   random.uniform(2, 6));
      const Eigen::Vector3d p_rectified = stereo.T_left_rectified.inverse() * p_left;
      const auto px_left = stereo.camera.project(p_rectified);
      if (!px_left) continue;
      // The definition of the rectified right eye: same row, disparity fx * baseline / z.
      const Eigen::Vector2d px_right =
          *px_left - Eigen::Vector2d(stereo.camera.fx * stereo.baseline_m / p_rectified.z(), 0);
      if (!stereo.camera.contains(*px_left, 2) || !stereo.camera.contains(px_right, 2)) continue;
      const auto raw_left = left.project(p_left);
      const auto raw_right = right.project(T_left_right.inverse() * p_left);
      ASSERT_TRUE(raw_left && raw_right);
      EXPECT_LT((raw_pixel(stereo.left, *px_left) - *raw_left).norm(), kMapTolerance_px);
      EXPECT_LT((raw_pixel(stereo.right, px_right) - *raw_right).norm(), kMapTolerance_px);
      ++seen;
    }
    EXPECT_GT(seen, 50);
  }
}

TEST(RectifyStereo, RefusesSwappedCamerasStackedCamerasAndUnlikeLenses) {
  const Camera camera = radial_tangential();
  const SE3 right(SO3(), Eigen::Vector3d(0.1, 0, 0)), left(SO3(), Eigen::Vector3d(-0.1, 0, 0));
  const SE3 below(SO3(), Eigen::Vector3d(0, 0.1, 0));
  EXPECT_NO_THROW(rectify_stereo(camera, camera, right));
  EXPECT_THROW(rectify_stereo(camera, camera, left), ArgumentError);
  EXPECT_THROW(rectify_stereo(camera, camera, below), ArgumentError);
  Camera fisheye = equidistant();
  fisheye.width = camera.width;
  EXPECT_THROW(rectify_stereo(camera, fisheye, right), ArgumentError);
  Camera smaller = camera;
  smaller.width = 640;
  EXPECT_THROW(rectify_stereo(camera, smaller, right), ArgumentError);
}

}  // namespace rectification_test
}  // namespace placegraph
