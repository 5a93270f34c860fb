#include <placegraph/io/synthetic/defects/defects.h>

#include <cmath>

#include "tests/support/message_of.h"

namespace placegraph {
namespace defects_test {

using test::message_of;
using ::testing::HasSubstr;

Calibration exact() {
  Calibration calibration;
  calibration.camera.width = 640;
  calibration.camera.height = 480;
  calibration.camera.fx = 500;
  calibration.camera.fy = 510;
  calibration.camera.cx = 320;
  calibration.camera.cy = 240;
  calibration.baseline_m = 0.5;
  calibration.camera_height_m = 1.6;
  calibration.depth = DepthCamera{calibration.camera, SE3(), 0.001};
  return calibration;
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(Defects, SetsAreFoundByName) {
  EXPECT_EQ(defects_from("none").time_jitter_s, 0);
  EXPECT_EQ(defects_from("hard-drive").rolling_shutter_s, 0.015);
  EXPECT_EQ(defects_from("hard-drive").depth_lag_s, 0);
  EXPECT_EQ(defects_from("hard-rgbd").depth_lag_s, 0.02);
  EXPECT_EQ(defects_from("hard-rgbd").undulation_m, 0);
  EXPECT_TRUE(has_depth_defects(defects_from("hard-rgbd")));
  EXPECT_FALSE(has_depth_defects(defects_from("hard-drive")));
  EXPECT_EQ(message_of<ArgumentError>([] { defects_from("soft"); }),
            "defects: 'soft' is none of none, hard-drive, hard-rgbd");
}

TEST(Defects, ListNamesWhatIsNotZero) {
  SyntheticDefects defects;
  EXPECT_EQ(defect_list(defects), "");
  defects.depth_lag_s = 0.02;
  defects.depth_holes = 0.1;
  EXPECT_EQ(defect_list(defects), "  depth_lag_s: 0.02\n  depth_holes: 0.1\n");
}

TEST(Defects, ValuesOutOfRangeAreRefused) {
  const auto complaint = [](double SyntheticDefects::*member, double value) {
    SyntheticDefects defects;
    defects.*member = value;
    return message_of<ArgumentError>([&] { check_ranges(defects); });
  };
  EXPECT_THAT(complaint(&SyntheticDefects::depth_holes, 1), HasSubstr("depth_holes"));
  EXPECT_THAT(complaint(&SyntheticDefects::time_jitter_s, -0.001), HasSubstr("time_jitter_s"));
  EXPECT_THAT(complaint(&SyntheticDefects::undulation_m, std::nan("")), HasSubstr("undulation_m"));
}

TEST(Miscalibrated, HasTheErrorsThatItStates) {
  constexpr double kError = 0.005;
  const Calibration truth = exact();
  std::vector<double> focal, cx, cy, baseline, height, depth_focal, difference;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const Calibration written = synthetic::miscalibrated(truth, kError, seed);
    focal.push_back(written.camera.fx / truth.camera.fx - 1);
    EXPECT_NEAR(written.camera.fy / truth.camera.fy - 1, focal.back(), 1e-12);
    cx.push_back(written.camera.cx - truth.camera.cx);
    cy.push_back(written.camera.cy - truth.camera.cy);
    baseline.push_back(written.baseline_m / truth.baseline_m - 1);
    height.push_back(*written.camera_height_m / *truth.camera_height_m - 1);
    depth_focal.push_back(written.depth->camera.fx / truth.camera.fx - 1);
    difference.push_back(depth_focal.back() - focal.back());
  }
  // 2000 draws give sigma to 1.6 %.
  for (const auto* share : {&focal, &baseline, &height, &depth_focal})
    EXPECT_NEAR(root_mean_square(*share), kError, 0.07 * kError);
  EXPECT_NEAR(root_mean_square(difference), kError * std::sqrt(2.0), 0.1 * kError);
  for (const auto* shift : {&cx, &cy})
    EXPECT_NEAR(root_mean_square(*shift), kError * truth.camera.fx, 0.07 * kError * 500);
}

TEST(Miscalibrated, WithoutErrorItIsTheSame) {
  const Calibration truth = exact(), written = synthetic::miscalibrated(truth, 0, 5);
  EXPECT_EQ(written.camera.fx, truth.camera.fx);
  EXPECT_EQ(written.camera.cy, truth.camera.cy);
  EXPECT_EQ(written.baseline_m, truth.baseline_m);
  EXPECT_EQ(written.depth->camera.cx, truth.camera.cx);
}

}  // namespace defects_test
}  // namespace placegraph
