#include <gtest/gtest.h>
#include <placegraph/pipeline/lines/line_second_camera.h>

#include "tests/unit/pipeline/lines/edge_tracks.h"

namespace placegraph {
namespace line_second_camera_test {

using namespace test;

using Eigen::Vector2d;
using Eigen::Vector3d;

TEST(LineSecondCamera, EveryPointMovesByTheErrorAtTheLeftPointOfItsRow) {
  const RectificationError error{-0.4, 0.3, 0.2};
  const Vector2d left_a(300, 100), left_b(340, 300);
  const auto moved = corrected({Vector3d(0.5, 0, 0), {250, 150}, {260, 200}, 0.2}, line_camera(),
                               left_a, left_b, error);
  // Rows 150 and 200 of the left line lie at columns 310 and 320.
  EXPECT_NEAR(moved.start_px.x(), 250 + error.at({-10.0 / 500, -90.0 / 500}), 1e-9);
  EXPECT_NEAR(moved.end_px.x(), 260 + error.at({0, -40.0 / 500}), 1e-9);
  EXPECT_EQ(moved.start_px.y(), 150);
  EXPECT_EQ(moved.end_px.y(), 200);
}

/// A grey image with a bright upright stripe of 20 columns, its edges at `column` and beyond.
Image stripe(int column) {
  Image image(480, 640, CV_8UC1);
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x)
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(
          x >= column && x < column + 20 ? 200 : 60 + (x / 8 + y / 8) % 2 * 10);
  return image;
}

TEST(LineSecondCamera, TheRightCameraSeesTheEdgeByItsDisparityAndTheRectificationIsTakenOff) {
  Calibration calibration;
  calibration.camera = line_camera();
  calibration.baseline_m = 0.5;
  Frame frame;
  frame.image = stripe(300);
  frame.right = stripe(275);
  const LineSegment edge{{299.5, 360}, {299.5, 120}};  // bright on its right
  const auto plain = second_cameras(frame, {edge}, calibration, {}, {}, {});
  ASSERT_EQ(plain.size(), 1u);
  ASSERT_TRUE(plain[0]);
  EXPECT_NEAR(plain[0]->start_px.x(), 274.5, 0.1);
  EXPECT_NEAR(plain[0]->end_px.x(), 274.5, 0.1);
  EXPECT_EQ(plain[0]->second_in_cam, Vector3d(0.5, 0, 0));
  const auto off = second_cameras(frame, {edge}, calibration, {1.5, 0, 0}, {}, {});
  ASSERT_TRUE(off[0]);
  EXPECT_NEAR(off[0]->start_px.x() - plain[0]->start_px.x(), 1.5, 1e-9);
}

TEST(LineSecondCamera, WithoutASecondImageThereIsNoSecondCamera) {
  Calibration calibration;
  calibration.camera = line_camera();
  calibration.baseline_m = 0.5;
  Frame frame;
  frame.image = stripe(300);
  const auto kitti_cameras =
      second_cameras(frame, {LineSegment{{299.5, 360}, {299.5, 120}}}, calibration, {}, {}, {});
  ASSERT_EQ(kitti_cameras.size(), 1u);
  EXPECT_FALSE(kitti_cameras[0]);
}

/// An upright line 5 m ahead, seen by keyframes along x that are `step_m` apart.
SlidingWindow window_with_line(int keyframes, bool right, double step_m = 0.4) {
  SlidingWindow window({}, line_camera());
  window.add_line(LineId(7), Line3::from_direction(Vector3d(0.2, 0, 5), Vector3d::UnitY()));
  for (int k = 0; k < keyframes; ++k) {
    window.add_keyframe(KeyframeId(k), SE3(SO3(), Vector3d(step_m * k, 0, 0)));
    const double u = 320 + 500 * (0.2 - step_m * k) / 5;
    LineObservation o{KeyframeId(k), LineId(7), {u, 140}, {u, 340}, 0.2, {}};
    const double disparity = 500 * 0.5 / 5 + 0.7;  // measured 0.7 px too large
    if (right)
      o.second = LineObservation::SecondCamera{
          Vector3d(0.5, 0, 0), {u - disparity, 150}, {u - disparity, 330}, 0.2};
    window.add_line_observation(o);
  }
  return window;
}

TEST(LineSecondCamera, DisparityStandsBesideWhatMotionSays) {
  Calibration calibration;
  calibration.camera = line_camera();
  calibration.baseline_m = 0.5;
  const auto sample =
      disparity_of_line(window_with_line(5, true), LineId(7), calibration, {0.25, 0, 0}, {});
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->from_motion_px, 50, 1e-6);
  EXPECT_NEAR(sample->measured_px, 50.7 + 0.25, 1e-6);  // before it was corrected
  EXPECT_NEAR(sample->ray.x(), (0.2 - 1.6) / 5, 1e-9);
  EXPECT_GT(sample->sigma_px, 0.28);  // both cameras
}

TEST(LineSecondCamera, ThereIsNoSampleWithoutASecondCameraOrWithTooLittleMotion) {
  Calibration calibration;
  calibration.camera = line_camera();
  calibration.baseline_m = 0.5;
  EXPECT_FALSE(disparity_of_line(window_with_line(5, false), LineId(7), calibration, {}, {}));
  EXPECT_FALSE(disparity_of_line(window_with_line(1, true), LineId(7), calibration, {}, {}));
  LineTriangulationOptions options;
  options.min_rotation_deg = 0.5;
  EXPECT_TRUE(
      disparity_of_line(window_with_line(3, true, 0.5), LineId(7), calibration, {}, options));
  // A tenth of the baseline of the cameras: motion knows the disparity ten times worse.
  EXPECT_FALSE(
      disparity_of_line(window_with_line(3, true, 0.025), LineId(7), calibration, {}, options));
}

}  // namespace line_second_camera_test
}  // namespace placegraph
