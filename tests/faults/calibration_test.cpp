#include "tests/faults/small_recording.h"

namespace placegraph::faults::test {
namespace calibration_test {

TEST(FaultCalibration, StatesOtherIntrinsics) {
  const Recording recording = small_recording();
  const auto camera = [&](const char* name) { return faulty(recording, name).calibration.camera; };
  EXPECT_NEAR(camera("focal_plus_5").fx, 84, 1e-9);
  EXPECT_NEAR(camera("focal_minus_5").fy, 76, 1e-9);
  EXPECT_NEAR(camera("focal_plus_10").fy, 88, 1e-9);
  EXPECT_NEAR(camera("focal_minus_10").fx, 72, 1e-9);
  EXPECT_NEAR(camera("focal_plus_20").fx, 96, 1e-9);
  EXPECT_NEAR(camera("focal_minus_20").fx, 64, 1e-9);
  EXPECT_NEAR(camera("aspect_off").fx, 88, 1e-9);
  EXPECT_NEAR(camera("aspect_off").fy, 80, 1e-9);
  EXPECT_NEAR(camera("principal_point_x").cx, 55.6, 1e-9);
  EXPECT_NEAR(camera("principal_point_y").cy, 37.4, 1e-9);
  EXPECT_NEAR(faulty(recording, "focal_plus_5").calibration.depth->camera.fx, 84, 1e-9);
}

TEST(FaultCalibration, StatesOtherLengths) {
  const Recording recording = small_recording();
  const auto height = [&](const char* name) {
    return faulty(recording, name).calibration.camera_height_m.value();
  };
  const auto baseline = [&](const char* name) {
    return faulty(recording, name).calibration.baseline_m;
  };
  EXPECT_NEAR(height("camera_height_10x"), 15, 1e-9);
  EXPECT_NEAR(height("camera_height_100x"), 150, 1e-9);
  EXPECT_NEAR(height("camera_height_half"), 0.75, 1e-9);
  EXPECT_NEAR(baseline("baseline_2x"), 0.4, 1e-9);
  EXPECT_NEAR(baseline("baseline_half"), 0.1, 1e-9);
  EXPECT_NEAR(baseline("baseline_1000x"), 200, 1e-9);
}

/// An image whose grey level is its column: where each pixel of the result comes from.
Recording with_columns() {
  Recording recording = small_recording();
  for (int u = 0; u < 96; ++u) recording.frames[0].image.col(u) = 2 * u;
  return recording;
}

TEST(FaultCalibration, DistortsAsTheLensModelSays) {
  const Recording recording = with_columns();
  const Camera& c = recording.calibration.camera;
  for (const auto& [name, k1] : {std::pair{"distortion_plus", 0.15},
                                 {"distortion_minus", -0.15},
                                 {"distortion_strong", -0.3}}) {
    SCOPED_TRACE(name);
    const Recording out = faulty(recording, name);
    const double fx = out.calibration.camera.fx;
    for (const double u : {20.0, 30.0, 70.0, 80.0}) {
      const double x = (u - c.cx) / c.fx, distorted = c.cx + fx * x * (1 + k1 * x * x);
      EXPECT_NEAR(out.frames[0].image.at<uchar>(31, static_cast<int>(std::lround(distorted))),
                  2 * u, 2.1)
          << u;
    }
  }
}

}  // namespace calibration_test
}  // namespace placegraph::faults::test
