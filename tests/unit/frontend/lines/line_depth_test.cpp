#include <gtest/gtest.h>
#include <placegraph/frontend/lines/line_depth.h>
#include <placegraph/frontend/lines/line_triangulation.h>

#include "tests/support/scenes/scene.h"

namespace placegraph {
namespace line_depth_test {

const Camera kCamera = test::pinhole(160, 120, 140);

DepthCamera depth_camera() {
  DepthCamera camera;
  camera.camera = kCamera;
  camera.sigma_at_1m = 0.005;
  return camera;
}

/// Depth of a near wall left of the column `edge`, a far one right of it.
Image two_walls(double edge, double near_m, double far_m) {
  Image depth(kCamera.height, kCamera.width, CV_32FC1);
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u)
      depth.at<float>(v, u) = static_cast<float>(u < edge ? near_m : far_m);
  return depth;
}

TEST(LineDepth, OfASlantedSurfaceIsAffineInverseDepthAlongTheEdge) {
  Image depth(kCamera.height, kCamera.width, CV_32FC1);
  const auto inverse = [](double u, double v) { return 0.2 + 0.001 * u + 0.0005 * v; };
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u)
      depth.at<float>(v, u) = static_cast<float>(1 / inverse(u, v));
  const LineSegment segment{{40, 30}, {100, 90}};
  const auto along = lookup_depth_along(depth, kCamera, depth_camera(), {segment})[0];
  ASSERT_TRUE(along);
  EXPECT_NEAR(along->inverse_depth_start, inverse(40, 30), 1e-3);
  EXPECT_NEAR(along->inverse_depth_end, inverse(100, 90), 1e-3);
}

TEST(LineDepth, OfAnEdgeBeforeABackgroundIsTheNearOnes) {
  const LineSegment segment{{80, 100}, {80, 20}};
  const auto along = lookup_depth_along(two_walls(80, 2, 6), kCamera, depth_camera(), {segment})[0];
  ASSERT_TRUE(along);
  EXPECT_NEAR(along->inverse_depth_start, 0.5, 0.01);
  EXPECT_NEAR(along->inverse_depth_end, 0.5, 0.01);
}

TEST(LineDepth, SaysNothingWhereThereIsNoDepth) {
  const Image none(kCamera.height, kCamera.width, CV_32FC1, cv::Scalar(0));
  EXPECT_FALSE(lookup_depth_along(none, kCamera, depth_camera(), {{{80, 100}, {80, 20}}})[0]);
}

TEST(LineDepth, AVirtualCameraSeesTheLineOfThoseDepths) {
  const Line3 line = Line3::from_direction({0.2, -0.3, 3}, {0.5, 1, 0.4});
  const auto on_line = [&](double s) -> Eigen::Vector3d {
    return line.nearest_point() + s * line.direction();
  };
  const Eigen::Vector3d a = on_line(0.5), b = on_line(1.5);
  const LineSegment segment{*kCamera.project(a), *kCamera.project(b)};
  const VirtualCamera second_camera =
      virtual_camera_from_depth(kCamera, segment, {1 / a.z(), 1 / b.z(), 0.005});
  const auto r = line_residual_px(kCamera, SE3(SO3(), second_camera.second_in_cam), line,
                                  second_camera.seen.first, second_camera.seen.second);
  ASSERT_TRUE(r);
  EXPECT_LT(r->norm(), 1e-9);
  EXPECT_GT(second_camera.seen.sigma_px, 0);
  EXPECT_GT(second_camera.second_in_cam.norm(), 0);
}

}  // namespace line_depth_test
}  // namespace placegraph
