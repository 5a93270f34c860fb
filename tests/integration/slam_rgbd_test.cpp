// RGB-D in a rendered corridor, by small images and by sensors that do not see far: depth must not
// make it worse than one eye alone.
#include <gtest/gtest.h>
#include <placegraph/io/synthetic/worlds/synthetic_world.h>
#include <placegraph/pipeline/slam.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace slam_rgbd_test {

struct DepthSetting {
  int width, height;
  double farthest_m;  ///< beyond it the sensor measures nothing
  double most_m;      ///< error of the last position
};

void PrintTo(const DepthSetting& s, std::ostream* out) {
  *out << s.width << "x" << s.height << " to " << s.farthest_m << " m";
}

class SlamWithDepth : public testing::TestWithParam<DepthSetting> {};

TEST_P(SlamWithDepth, PosesEveryFrame) {
  const DepthSetting& setting = GetParam();
  SyntheticOptions rendered;
  rendered.world = "corridor-loop";
  rendered.seed = 0;
  rendered.width = setting.width, rendered.height = setting.height;
  const SyntheticWorld world(rendered);
  Calibration calibration = world.calibration();
  calibration.baseline_m = 0;
  Slam slam({}, calibration);
  SyntheticContents contents;
  contents.depth = true;
  constexpr std::size_t kFrames = 24;  // 2.3 m
  Eigen::Isometry3d T_map_last = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < kFrames; ++i) {
    Frame frame = world.render(i, contents).frame;
    frame.depth.setTo(0, frame.depth > setting.farthest_m);
    const FrameResult result = slam.add_frame(frame);
    ASSERT_TRUE(result.T_map_cam) << "frame " << i;
    T_map_last = result.T_map_cam->isometry();
  }
  const Trajectory truth = world.ground_truth();
  EXPECT_LT(
      (T_map_last.translation() - truth.poses[kFrames - 1].T_world_body->translation()).norm(),
      setting.most_m);
}

INSTANTIATE_TEST_SUITE_P(Sensors, SlamWithDepth,
                         testing::Values(DepthSetting{320, 240, 100, 0.03},
                                         DepthSetting{424, 240, 100, 0.03},
                                         DepthSetting{161, 121, 100, 0.08},
                                         DepthSetting{320, 240, 3, 0.05}));

}  // namespace slam_rgbd_test
}  // namespace placegraph
