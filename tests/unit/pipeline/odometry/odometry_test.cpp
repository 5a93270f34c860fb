#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/odometry/odometry.h>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace odometry_test {

using namespace test;

const StreetDataset& frames(bool with_depth = false) {
  static const StreetDataset stereo(12), depth(6, 0, 0, true);
  return with_depth ? depth : stereo;
}
double error(const SE3& a, const SE3& b) { return (a.inverse() * b).log().norm(); }

/// An image of its own: zeros() would be written into the image that it is assigned to.
Image black() {
  return Image(street_camera().height, street_camera().width, CV_8UC1, cv::Scalar(0));
}

struct Street {
  StageTimes times;
  Sensor sensor;
  Odometry odometry;
  Street(Sensor s, const std::string& cues, std::optional<double> height_m = {})
      : sensor(s), odometry(options(cues), calibration(s, height_m), 1, {}, times) {
    odometry.restart(street_T_world_cam(0));
  }
  static OdometryOptions options(const std::string& cues) {
    OdometryOptions o;
    o.cues = cues;
    return o;
  }
  static Calibration calibration(Sensor sensor, std::optional<double> height_m) {
    Calibration c = frames(sensor == Sensor::kRgbd).calibration(sensor);
    c.camera_height_m = height_m;
    return c;
  }
  OdometryUpdate add(int i) {
    return odometry.add_frame(frames(sensor == Sensor::kRgbd).frame(i, sensor));
  }
};

TEST(Odometry, AStereoCameraBeginsWithTheFirstFrameAndFollowsTheStreet) {
  Street run(Sensor::kStereo, "points");
  for (int i = 0; i < 8; ++i) {
    const OdometryUpdate update = run.add(i);
    ASSERT_EQ(update.state, TrackingState::kTracking) << i << update.outcome.reason;
    EXPECT_LT(error(update.T_odom_cam, street_T_world_cam(i)), 0.03) << i;
    if (i == 0) {
      EXPECT_EQ(update.new_keyframes.size(), 1u);
    }
  }
  EXPECT_TRUE(run.odometry.map().metric());
  EXPECT_FALSE(run.odometry.view().tracks.empty());
  EXPECT_GT(run.odometry.points_cam().size(), 50u);
}

TEST(Odometry, AnRgbdCameraBeginsWithTheFirstFrame) {
  Street run(Sensor::kRgbd, "points");
  for (int i = 0; i < 5; ++i) {
    const OdometryUpdate update = run.add(i);
    ASSERT_EQ(update.state, TrackingState::kTracking) << i << update.outcome.reason;
    EXPECT_LT(error(update.T_odom_cam, street_T_world_cam(i)), 0.03) << i;
  }
}

TEST(Odometry, AMonocularCameraWaitsForParallaxAndThenPosesTheFramesThatWaited) {
  Street run(Sensor::kMono, "points");
  OdometryUpdate update = run.add(0);
  EXPECT_EQ(update.state, TrackingState::kInitializing);
  EXPECT_TRUE(update.reference);
  EXPECT_TRUE(run.odometry.started());
  int i = 1;
  for (; i < 12 && update.state != TrackingState::kTracking; ++i) update = run.add(i);
  ASSERT_EQ(update.state, TrackingState::kTracking);
  ASSERT_EQ(update.new_keyframes.size(), 2u);
  EXPECT_EQ(update.new_keyframes[0].frame.id, FrameId(0));
  EXPECT_EQ(update.new_keyframes[1].frame.id, FrameId(i - 1));
  EXPECT_EQ(update.posed_again.size(), static_cast<std::size_t>(i - 2));
  EXPECT_FALSE(run.odometry.map().metric());
  // The direction of the motion is that of the street.
  const SE3 found = run.odometry.map().pose(KeyframeId(0)).inverse() * update.T_odom_cam;
  const SE3 truth = street_T_world_cam(0).inverse() * street_T_world_cam(i - 1);
  EXPECT_GT(found.translation().normalized().dot(truth.translation().normalized()), 0.998);
}

TEST(Odometry, FramesBetweenTheTwoViewsArePosedByTheirPoints) {
  const auto slowly = [](int i) {
    return SE3(SO3(), Eigen::Vector3d(0.03 * i, -kStreetHeight_m, 0.02 * i));
  };
  const StreetDataset slow(16, 0, 0, false, slowly);
  StageTimes times;
  Odometry odometry(Street::options("points"), slow.calibration(Sensor::kMono), 1, {}, times);
  OdometryUpdate update;
  int i = 0;
  for (; i < 16 && update.state != TrackingState::kTracking; ++i)
    update = odometry.add_frame(slow.frame(i, Sensor::kMono));
  ASSERT_EQ(update.state, TrackingState::kTracking);
  std::map<FrameId, SE3> posed;  // later ones are better than by the rotation alone
  for (const PosedFrame& frame : update.posed_again) posed[frame.first] = frame.second;
  ASSERT_GE(i, 4);
  for (int k = 1; k + 1 < i; ++k) {
    ASSERT_TRUE(posed.contains(FrameId(k))) << k;
    const double share =
        posed[FrameId(k)].translation().norm() / update.T_odom_cam.translation().norm();
    EXPECT_NEAR(share, static_cast<double>(k) / (i - 1), 0.15) << k;
  }
}

TEST(Odometry, TheHeightOfAMonocularCameraGivesItsScale) {
  Street run(Sensor::kMono, "points,plane", kStreetHeight_m);
  OdometryUpdate update;
  int i = 0;
  for (; i < 12 && !run.odometry.map().metric(); ++i) update = run.add(i);
  ASSERT_TRUE(run.odometry.map().metric());
  const SE3 found = run.odometry.map().pose(KeyframeId(0)).inverse() * update.T_odom_cam;
  const SE3 truth = street_T_world_cam(0).inverse() * street_T_world_cam(i - 1);
  EXPECT_NEAR(found.translation().norm() / truth.translation().norm(), 1, 0.05);
}

TEST(Odometry, SurfacesAloneFollowTheGround) {
  Street run(Sensor::kStereo, "plane", kStreetHeight_m);
  for (int i = 0; i < 5; ++i) {
    const OdometryUpdate update = run.add(i);
    ASSERT_EQ(update.state, TrackingState::kTracking) << i << update.outcome.reason;
    EXPECT_LT(error(update.T_odom_cam, street_T_world_cam(i)), 0.1) << i;
  }
  EXPECT_FALSE(run.odometry.view().surfaces.empty());
}

TEST(Odometry, AFrameThatCannotBePosedLeavesTheTracksAsTheyWere) {
  Street run(Sensor::kStereo, "points");
  for (int i = 0; i < 3; ++i) ASSERT_EQ(run.add(i).state, TrackingState::kTracking);
  Frame dark = frames().frame(3, Sensor::kStereo);
  dark.image = black();
  const OdometryUpdate lost = run.odometry.add_frame(dark);
  EXPECT_EQ(lost.state, TrackingState::kLost);
  EXPECT_FALSE(lost.outcome.reason.empty());
  EXPECT_TRUE(run.odometry.view().tracks.empty());
  const OdometryUpdate found = run.add(4);
  ASSERT_EQ(found.state, TrackingState::kTracking) << found.outcome.reason;
  EXPECT_LT(error(found.T_odom_cam, street_T_world_cam(4)), 0.05);
}

TEST(Odometry, AnEmptyFirstFrameIsNothingToBeginWith) {
  for (const Sensor sensor : {Sensor::kStereo, Sensor::kMono}) {
    Street run(sensor, "points");
    Frame dark = frames().frame(0, sensor);
    dark.image = black();
    const OdometryUpdate nothing = run.odometry.add_frame(dark);
    EXPECT_EQ(nothing.state, TrackingState::kInitializing);
    EXPECT_FALSE(nothing.outcome.reason.empty());
    EXPECT_FALSE(nothing.reference);
    EXPECT_FALSE(run.odometry.started());
    EXPECT_TRUE(run.odometry.map().empty());
    EXPECT_TRUE(run.odometry.map().landmarks().empty());
    (void)run.add(1);
    EXPECT_TRUE(run.odometry.started());
  }
}

TEST(Odometry, ARestartCountsKeyframesOnAndKeepsLandmarks) {
  Street run(Sensor::kStereo, "points");
  for (int i = 0; i < 4; ++i) (void)run.add(i);
  const KeyframeId newest = run.odometry.map().newest();
  const std::size_t landmarks = run.odometry.map().landmarks().size();
  run.odometry.restart(street_T_world_cam(5), true);
  EXPECT_FALSE(run.odometry.started());
  EXPECT_EQ(run.odometry.map().settled_landmarks(), landmarks);
  const OdometryUpdate update = run.add(5);
  ASSERT_EQ(update.state, TrackingState::kTracking);
  EXPECT_EQ(update.keyframe, ++KeyframeId(newest));
  EXPECT_LT(error(update.T_odom_cam, street_T_world_cam(5)), 1e-9);
}

TEST(Odometry, RefusesCuesThatTheCameraCannotServe) {
  StageTimes times;
  const Calibration mono = Street::calibration(Sensor::kMono, std::nullopt);
  EXPECT_THROW(Odometry(Street::options("plane"), mono, 1, {}, times), ArgumentError);
  EXPECT_THROW(Odometry(Street::options("points,direct"), mono, 1, {}, times), ArgumentError);
  Calibration distorted = mono;
  distorted.camera.distortion = Distortion::kRadialTangential;
  EXPECT_THROW(Odometry({}, distorted, 1, {}, times), ArgumentError);
}

TEST(Odometry, LawAnotherOdometryFrameMovesEveryPoseByThatFrame) {
  const SE3 T_other(SO3::exp({0.2, -1.0, 0.5}), Eigen::Vector3d(100, -3, 7));
  Street here(Sensor::kStereo, "points"), there(Sensor::kStereo, "points");
  there.odometry.restart(T_other * street_T_world_cam(0));
  for (int i = 0; i < 4; ++i) {
    const SE3 a = here.add(i).T_odom_cam, b = there.add(i).T_odom_cam;
    EXPECT_LT(error(T_other * a, b), 1e-3) << i;
  }
}

}  // namespace odometry_test
}  // namespace placegraph
