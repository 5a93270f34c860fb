#include <gtest/gtest.h>
#include <placegraph/io/synthetic/render/rolling_shutter.h>
#include <placegraph/io/synthetic/render/sensor_model.h>

#include <cmath>

namespace placegraph::synthetic {
namespace rolling_shutter_test {

constexpr double kSpeed_mps = 2, kReadout_s = 0.04, kDistance_m = 2, kFocal_px = 500;

/// A wall whose left edge is 0.1 m right of the camera's axis.
Scene wall() {
  Scene scene;
  scene.outdoor = false;
  Part part;
  part.faces.push_back(make_quad({0.1, 2, kDistance_m}, {0, -4, 0}, {3, 0, 0}, Material::kConcrete,
                                 SurfaceClass::kIndoorWall, 1));
  if (part.faces[0].normal[2] > 0)
    part.faces[0] = make_quad({0.1, 2, kDistance_m}, {3, 0, 0}, {0, -4, 0}, Material::kConcrete,
                              SurfaceClass::kIndoorWall, 1);
  part.finish();
  scene.parts.push_back(part);
  return scene;
}

/// The view of a camera that moves to the right.
View view_after(double delay_s) {
  View view;
  view.camera.width = 160;
  view.camera.height = 101;
  view.camera.fx = view.camera.fy = kFocal_px;
  view.camera.cx = 80;
  view.camera.cy = 50;
  view.T_scene_cam = SE3(SO3(), Eigen::Vector3d(kSpeed_mps * delay_s, 0, 0));
  return view;
}

/// First column of the wall in a row.
double edge_column(const Image& image, int row) {
  for (int u = 0; u < image.cols; ++u)
    if (image.at<unsigned char>(row, u) > 60) return u;
  return -1;
}

Image photograph(double readout_s) {
  const SensorModel model;
  const View view = view_after(0);
  const Scene scene = wall();
  const Rendering seen = readout_s > 0 ? render_rolling(scene, view_after, readout_s, 1, 1)
                                       : render(scene, view, 1, false, 1);
  return expose(seen, view, point_velocities(scene, view, {kSpeed_mps, 0, 0}, {0, 0, 0}), model, 1,
                2);
}

TEST(RollingShutter, EveryRowIsSeenAtItsOwnTime) {
  const Image image = photograph(kReadout_s);
  const double at_stamp = 80 + kFocal_px * 0.1 / kDistance_m;
  double sum = 0;
  for (int row = 0; row < image.rows; ++row) {
    const double delay_s = kReadout_s * (row / 100.0 - 0.5);
    const double expected = at_stamp - kFocal_px * kSpeed_mps * delay_s / kDistance_m;
    // Whole columns, and 0.3 px of motion within the rows that are rendered together.
    ASSERT_NEAR(edge_column(image, row), expected, 1.3) << row;
    sum += edge_column(image, row) - expected;
  }
  EXPECT_NEAR(sum / image.rows, 0, 0.6);  // of columns in whole pixels
  EXPECT_NEAR(edge_column(image, 0) - edge_column(image, 100), 20, 1);  // 500 px/s in 0.04 s
}

TEST(RollingShutter, WithoutReadoutAllRowsAreEqual) {
  const Image image = photograph(0);
  for (int row = 0; row < image.rows; ++row) EXPECT_EQ(edge_column(image, row), 105);
}

TEST(RollingShutter, BandsOfAStandingCameraMakeTheWholeImage) {
  const Scene scene = wall();
  const View view = view_after(0);
  const auto standing = [&](double) { return view; };
  const Rendering whole = render(scene, view, 1, false, 1),
                  bands = render_rolling(scene, standing, kReadout_s, 1, 2);
  for (int v = 0; v < view.camera.height; ++v)
    for (int u = 0; u < view.camera.width; ++u) {
      ASSERT_NEAR(bands.inverse_depth.at<float>(v, u), whole.inverse_depth.at<float>(v, u), 1e-6);
      ASSERT_NEAR(bands.grey.at<float>(v, u), whole.grey.at<float>(v, u), 1e-3);
    }
}

}  // namespace rolling_shutter_test
}  // namespace placegraph::synthetic
