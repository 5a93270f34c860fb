#include <gtest/gtest.h>
#include <placegraph/pipeline/tracking/direct_tracker.h>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace direct_tracker_test {

using namespace test;

const StreetDataset& drive() {
  static const StreetDataset dataset(4);
  return dataset;
}
/// The camera stands still.
const StreetDataset& stands() {
  static const StreetDataset dataset(2, 0, 0, false, [](int) { return street_T_world_cam(0); });
  return dataset;
}

struct Tracking {
  const StreetDataset& dataset;
  StageTimes times;
  OdometryOptions options;
  Calibration calibration;
  DirectTracker tracker;
  LocalMap map;
  MotionModel motion{street_T_world_cam(0)};

  explicit Tracking(const StreetDataset& d = drive(), int max_interval = 20)
      : dataset(d),
        options(ground_alone(max_interval)),
        calibration(with_height(d)),
        tracker(options, calibration, 1, {}, times),
        map(options.window, calibration.camera, Scale::kMetric) {}
  static OdometryOptions ground_alone(int max_interval) {
    OdometryOptions options;
    options.cues = "plane";
    options.keyframe.max_interval = max_interval;
    return options;
  }
  static Calibration with_height(const Dataset& d) {
    Calibration calibration = d.calibration(Sensor::kStereo);
    calibration.camera_height_m = kStreetHeight_m;
    return calibration;
  }
  KeyframeImages images(int i) const {
    const Frame frame = dataset.frame(i, Sensor::kStereo);
    return {frame, frame.mask, nullptr};
  }
  /// Makes a frame that is posed at T_odom_cam a keyframe, as LocalMapping does.
  bool keyframe(int i, const SE3& T_odom_cam) {
    const auto T = tracker.prepare_keyframe(images(i), T_odom_cam, map);
    if (!T) return false;
    map.add_keyframe(*T);
    tracker.observe(images(i), {}, map);
    map.update_poses(tracker.prune(map), false);
    (void)tracker.finish_keyframe(1, map);
    return true;
  }
  TrackedFrame track(int i) {
    TrackedFrame tracked = tracker.track(dataset.frame(i, Sensor::kStereo), map, motion);
    if (tracked.outcome) motion.update(tracked.T_odom_cam);
    return tracked;
  }
};
double error(const SE3& a, const SE3& b) { return (a.inverse() * b).log().norm(); }

TEST(DirectTracker, AlignsFramesWithTheSurfacesOfTheLastKeyframe) {
  Tracking t;
  ASSERT_TRUE(t.keyframe(0, street_T_world_cam(0)));
  for (int i = 1; i <= 2; ++i) {
    const TrackedFrame tracked = t.track(i);
    ASSERT_TRUE(tracked.outcome) << i << tracked.outcome.reason;
    EXPECT_LT(error(tracked.T_odom_cam, street_T_world_cam(i)), 0.04) << i;
    EXPECT_GT(tracked.inliers, 50) << i;
    EXPECT_FALSE(tracked.rotation);
  }
  EXPECT_FALSE(t.tracker.view(t.map, SE3()).surfaces.empty());
}

TEST(DirectTracker, TheFirstKeyframeIsAtItsGivenPoseAndHasTheDepthOfItsSurfaces) {
  Tracking t;
  t.map.restart(Scale::kMetric, 50);  // what another segment saw
  ASSERT_TRUE(t.keyframe(0, street_T_world_cam(0)));
  EXPECT_LT(error(t.map.pose(KeyframeId(0)), street_T_world_cam(0)), 1e-12);
  EXPECT_GT(t.map.median_depth(), 2 * kStreetHeight_m);  // of the road ahead
  EXPECT_LT(t.map.median_depth(), 8 * kStreetHeight_m);
  EXPECT_TRUE(t.map.window().factors().empty());  // a single keyframe has not moved
}

TEST(DirectTracker, TheMotionBetweenKeyframesGoesIntoTheWindow) {
  Tracking t;
  ASSERT_TRUE(t.keyframe(0, street_T_world_cam(0)));
  const TrackedFrame tracked = t.track(1);
  ASSERT_TRUE(tracked.outcome);
  ASSERT_TRUE(t.keyframe(1, tracked.T_odom_cam));
  ASSERT_EQ(t.map.window().factors().size(), 1u);
  EXPECT_EQ(t.map.window().factors()[0].variables,
            (std::vector{keyframe_variable(KeyframeId(0)), keyframe_variable(KeyframeId(1))}));
  EXPECT_LT(error(t.map.pose(KeyframeId(1)), street_T_world_cam(1)), 0.03);
  EXPECT_FALSE(t.tracker.keyframe_to_retry_from());  // it is the newest frame itself
}

TEST(DirectTracker, AFrameThatIsFarFromTheKeyframeIsDueAsOne) {
  Tracking t;
  ASSERT_TRUE(t.keyframe(0, street_T_world_cam(0)));
  TrackedFrame tracked;
  int i = 1;
  for (; i < 4 && !tracked.keyframe_due; ++i) {
    tracked = t.track(i);
    ASSERT_TRUE(tracked.outcome) << i;
    const double path = distance_m(tracked.T_odom_cam, t.map.pose(KeyframeId(0)));
    if (path > 0.3 * t.map.median_depth()) {
      EXPECT_TRUE(tracked.keyframe_due) << i;
    }
  }
}

TEST(DirectTracker, ACameraThatStandsKeepsItsKeyframe) {
  Tracking t(stands(), 1);  // a keyframe would be due with every frame
  ASSERT_TRUE(t.keyframe(0, street_T_world_cam(0)));
  const TrackedFrame tracked = t.track(1);
  ASSERT_TRUE(tracked.outcome);
  EXPECT_LT(error(tracked.T_odom_cam, street_T_world_cam(0)), 1e-3);
  EXPECT_FALSE(tracked.keyframe_due);
}

TEST(DirectTracker, AMovingCameraGetsAKeyframeAfterTheLongestInterval) {
  Tracking t(drive(), 1);
  ASSERT_TRUE(t.keyframe(0, street_T_world_cam(0)));
  const TrackedFrame tracked = t.track(1);
  ASSERT_TRUE(tracked.outcome);
  EXPECT_TRUE(tracked.keyframe_due);
}

TEST(DirectTracker, AfterALossTheLastPosedFrameMayHelpAsAKeyframe) {
  Tracking t;
  ASSERT_TRUE(t.keyframe(0, street_T_world_cam(0)));
  EXPECT_FALSE(t.tracker.keyframe_to_retry_from());  // it is the keyframe itself
  ASSERT_TRUE(t.track(1).outcome);
  Frame dark = drive().frame(2, Sensor::kStereo);
  dark.image = Image(dark.image.size(), CV_8UC1, cv::Scalar(0));
  EXPECT_FALSE(t.tracker.track(dark, t.map, t.motion).outcome);
  const auto retry = t.tracker.keyframe_to_retry_from();
  ASSERT_TRUE(retry);
  EXPECT_EQ(retry->id, FrameId(1));
}

TEST(DirectTracker, AFrameWithoutSurfacesIsNoKeyframe) {
  Tracking t;
  Frame dark = drive().frame(0, Sensor::kStereo);
  dark.image = dark.right = Image(dark.image.size(), CV_8UC1, cv::Scalar(0));
  EXPECT_FALSE(t.tracker.prepare_keyframe({dark, {}, nullptr}, SE3(), t.map));
  EXPECT_TRUE(t.keyframe(1, street_T_world_cam(1)));
}

TEST(DirectTracker, AResetForgetsTheSurfaces) {
  Tracking t;
  ASSERT_TRUE(t.keyframe(0, street_T_world_cam(0)));
  ASSERT_TRUE(t.track(1).outcome);
  t.tracker.reset();
  EXPECT_FALSE(t.tracker.keyframe_to_retry_from());
  EXPECT_TRUE(t.tracker.view(t.map, SE3()).surfaces.empty());
  EXPECT_FALSE(t.track(2).outcome);  // there is nothing to align it with
}

TEST(DirectTracker, HasNoLinesAndManhattanFramesOnlyIfTheyAreNamed) {
  Tracking t;
  EXPECT_EQ(t.tracker.lines(), nullptr);
  EXPECT_FALSE(t.tracker.corrects_rotations());
  OdometryOptions options = t.options;
  options.cues = "plane,manhattan";
  EXPECT_TRUE(DirectTracker(options, t.calibration, 1, {}, t.times).corrects_rotations());
}

}  // namespace direct_tracker_test
}  // namespace placegraph
