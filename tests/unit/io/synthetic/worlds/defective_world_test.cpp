#include <placegraph/io/synthetic/defects/camera_motion.h>
#include <placegraph/io/synthetic/worlds/synthetic_world.h>
#include <placegraph/io/synthetic/worlds/tours.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tests/support/clean_world.h"
#include "tests/support/message_of.h"

namespace placegraph {
namespace defective_world_test {

using synthetic::Rendering;
using synthetic::Tour;
using synthetic::View;
using test::message_of;
using ::testing::HasSubstr;

constexpr std::size_t kFrame = 40;  ///< moves in all worlds

SyntheticWorld open(const char* name, const SyntheticDefects& defects) {
  SyntheticOptions options = test::clean_world(name, 0, 248, 80);
  options.defects = defects;
  return SyntheticWorld(options);
}

/// What a camera without defects sees at a time.
Rendering seen_at(const SyntheticWorld& world, double time_s) {
  const Tour& tour = world.tour();
  const View view{tour.camera, synthetic::pose_at(tour.time_s, tour.T_scene_cam, time_s), time_s};
  return synthetic::render(tour.scene, view, 1, false, 1);
}

/// Mean difference of a row of an image and a rendering, in grey levels.
double row_difference(const Image& image, const Rendering& rendering, int row) {
  double sum = 0;
  for (int u = 0; u < image.cols; ++u)
    sum += std::abs(image.at<unsigned char>(row, u) -
                    std::min(255.0F, 255 * rendering.grey.at<float>(row, u)));
  return sum / image.cols;
}

double image_difference(const Image& image, const Rendering& rendering) {
  double sum = 0;
  for (int v = 0; v < image.rows; ++v) sum += row_difference(image, rendering, v) / image.rows;
  return sum;
}

bool equal(const Image& a, const Image& b) { return cv::norm(a, b, cv::NORM_INF) == 0; }

/// Largest difference of the poses of two worlds.
double pose_difference(const SyntheticWorld& a, const SyntheticWorld& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    worst = std::max(worst,
                     (a.tour().T_scene_cam[i].matrix() - b.tour().T_scene_cam[i].matrix()).norm());
  return worst;
}

TEST(DefectiveWorld, TimeJitterMovesTheExposureAndNothingElse) {
  constexpr double kJitter_s = 0.004;
  SyntheticDefects defects;
  defects.time_jitter_s = kJitter_s;
  const SyntheticWorld exact = open("town-loop", {}), world = open("town-loop", defects);
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < world.size(); ++i) {
    EXPECT_EQ(world.stamp_ns(i), exact.stamp_ns(i));
    const double error_s = world.exposure_time_s(i) - world.tour().time_s[i];
    sum += error_s;
    squares += error_s * error_s;
  }
  const auto n = static_cast<double>(world.size());  // about 750 frames: sigma to 2.6 %
  EXPECT_NEAR(sum / n, 0, 4 * kJitter_s / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), kJitter_s, 0.1 * kJitter_s);
  EXPECT_EQ(pose_difference(exact, world), 0);
  EXPECT_EQ(world.calibration().camera.fx, exact.calibration().camera.fx);
  // Rounding of grey levels is 0.25 in the mean.
  const Image image = world.render(kFrame, {}).frame.image;
  EXPECT_LT(image_difference(image, seen_at(world, world.exposure_time_s(kFrame))), 0.3);
  EXPECT_GT(image_difference(image, seen_at(world, world.tour().time_s[kFrame])), 0.5);
}

TEST(DefectiveWorld, RollingShutterTakesEachRowAtItsTime) {
  constexpr double kReadout_s = 0.03;
  SyntheticDefects defects;
  defects.rolling_shutter_s = kReadout_s;
  const SyntheticWorld exact = open("town-loop", {}), world = open("town-loop", defects);
  SyntheticContents stereo;
  stereo.right = true;
  const SyntheticFrame frame = world.render(kFrame, stereo);
  const double stamp_s = world.tour().time_s[kFrame];
  const Rendering at_stamp = seen_at(world, stamp_s);
  double own = 0, global = 0;
  for (int row = 2; row < 80; row += 7) {
    const double delay_s = kReadout_s * (row / 79.0 - 0.5);
    own += row_difference(frame.frame.image, seen_at(world, stamp_s + delay_s), row);
    global += row_difference(frame.frame.image, at_stamp, row);
  }
  EXPECT_LT(own, 0.4 * global);
  EXPECT_FALSE(equal(frame.frame.right, exact.render(kFrame, stereo).frame.right));
  EXPECT_EQ(pose_difference(exact, world), 0);
}

TEST(DefectiveWorld, CalibrationErrorChangesTheCalibrationOnly) {
  SyntheticDefects defects;
  defects.calibration_error = 0.005;
  const SyntheticWorld exact = open("corridor-loop", {}), world = open("corridor-loop", defects);
  SyntheticContents contents;
  contents.depth = contents.right = true;
  const SyntheticFrame a = exact.render(kFrame, contents), b = world.render(kFrame, contents);
  EXPECT_TRUE(equal(a.frame.image, b.frame.image));
  EXPECT_TRUE(equal(a.frame.right, b.frame.right));
  EXPECT_TRUE(equal(a.frame.depth, b.frame.depth));
  const Calibration written = world.calibration(), truth = exact.calibration();
  EXPECT_NE(written.camera.fx, truth.camera.fx);
  EXPECT_NE(written.baseline_m, truth.baseline_m);
  EXPECT_NE(written.depth->camera.fx, written.camera.fx);
  EXPECT_NE(*written.camera_height_m, *truth.camera_height_m);
}

TEST(DefectiveWorld, DepthLagGivesTheDepthOfAnEarlierTime) {
  SyntheticDefects defects;
  defects.depth_lag_s = 0.02;
  const SyntheticWorld exact = open("turning-walk", {}), world = open("turning-walk", defects);
  SyntheticContents contents;
  contents.depth = true;
  const SyntheticFrame a = exact.render(kFrame, contents), b = world.render(kFrame, contents);
  EXPECT_TRUE(equal(a.frame.image, b.frame.image));
  EXPECT_FALSE(equal(a.frame.depth, b.frame.depth));
  const double earlier_s = world.tour().time_s[kFrame] - 0.02;
  EXPECT_TRUE(equal(synthetic::depth_image(seen_at(world, earlier_s)), b.frame.depth));
}

TEST(DefectiveWorld, ShutterOverridesThatOfTheDifficulty) {
  SyntheticDefects defects;
  defects.shutter_s = 0.02;
  const SyntheticWorld exact = open("turning-walk", {}), world = open("turning-walk", defects);
  SyntheticContents contents;
  contents.depth = true;
  const SyntheticFrame a = exact.render(kFrame, contents), b = world.render(kFrame, contents);
  EXPECT_FALSE(equal(a.frame.image, b.frame.image));
  EXPECT_TRUE(equal(a.frame.depth, b.frame.depth));
}

TEST(DefectiveWorld, UndulationMovesGroundAndCameraByItsHeight) {
  SyntheticDefects defects;
  defects.undulation_m = 0.02;
  const SyntheticWorld exact = open("town-loop", {}), world = open("town-loop", defects);
  double squares = 0;
  for (std::size_t i = 0; i < world.size(); ++i) {
    const Eigen::Vector3d step =
        world.tour().T_scene_cam[i].translation() - exact.tour().T_scene_cam[i].translation();
    EXPECT_EQ(step[0], 0);
    squares += step[1] * step[1];
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(world.size())), 0.02, 0.008);
  EXPECT_EQ(*world.calibration().camera_height_m, *exact.calibration().camera_height_m);
  SyntheticOptions options = test::clean_world("warehouse", 3, 248, 80);
  options.defects = defects;
  EXPECT_THAT(message_of<ArgumentError>([&] { SyntheticWorld bad(options); }),
              HasSubstr("undulation_m: only for `town-loop` and pose files"));
}

}  // namespace defective_world_test
}  // namespace placegraph
