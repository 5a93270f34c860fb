#include <gtest/gtest.h>
#include <placegraph/pipeline/slam/track_recovery.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace track_recovery_test {

using namespace test;

/// A map with one keyframe at (1, 2, 3), and a stereo camera.
struct Scene {
  StageTimes times;
  Calibration calibration;
  Odometry odometry;
  LoopCloser closer;
  PlaceMapper mapper{PlaceOptions{}};
  TrajectoryRecorder recorder;
  std::vector<std::string> log;
  TrackRecovery recovery{{3, 0.002},
                         [this](LogLevel, const std::string& line) { log.push_back(line); }};
  SE3 T_map_keyframe{SO3::exp({0, 0.3, 0}), Eigen::Vector3d(1, 2, 3)};

  Scene()
      : calibration(calibrated()),
        odometry({}, calibration, 1, {}, times),
        closer({}, calibration, 1) {
    Frame first;
    recorder.begin(first);
    recorder.add_keyframe({KeyframeId(0), first});
    mapper.add_keyframe(KeyframeId(0), std::nullopt, T_map_keyframe, 10);
    recovery.stands_at(T_map_keyframe);
  }
  static Calibration calibrated() {
    Calibration c;
    c.camera = street_camera();
    c.baseline_m = kStreetBaseline_m;
    return c;
  }
  KnownMap known() const { return {closer, mapper, recorder}; }
  static Frame dark(std::int64_t id) {
    Frame f;
    f.id = FrameId(id);
    f.stamp_ns = id * 1'000'000'000;
    f.image = Image::zeros(street_camera().height, street_camera().width, CV_8UC1);
    f.right = f.image;
    return f;
  }
  void show_dark(std::int64_t id) { (void)recovery.handle(dark(id), known(), odometry); }
  OdometryUpdate show_street(std::int64_t id) {
    Frame seen = StreetDataset(1).frame(0, Sensor::kStereo);
    seen.id = FrameId(id);
    seen.stamp_ns = id * 1'000'000'000;
    return recovery.handle(seen, known(), odometry);
  }
  /// Number of components that have begun.
  int components() const {
    return static_cast<int>(std::ranges::count_if(log, [](const std::string& line) {
      return line.ends_with("a new component of the map begins");
    }));
  }
};
double error(const SE3& a, const SE3& b) { return (a.inverse() * b).log().norm(); }

TEST(TrackRecovery, BeginsANewComponentAfterTooManyLostFrames) {
  Scene scene;
  for (int i = 1; i <= 3; ++i) {
    EXPECT_EQ(scene.components(), 0) << i;
    scene.show_dark(i);
  }
  EXPECT_EQ(scene.components(), 1);
  EXPECT_FALSE(scene.recovery.take_link(scene.odometry.map(), scene.mapper));
  const OdometryUpdate begun = scene.show_street(9);
  ASSERT_EQ(begun.state, TrackingState::kTracking);
  EXPECT_LT(error(begun.T_odom_cam, scene.T_map_keyframe), 1e-9);  // where the last pose was
}

TEST(TrackRecovery, BeforeTheFirstKeyframeNothingIsLost) {
  Scene scene;
  const TrajectoryRecorder nothing;
  for (int i = 1; i <= 9; ++i)
    (void)scene.recovery.handle(Scene::dark(i), {scene.closer, scene.mapper, nothing},
                                scene.odometry);
  EXPECT_EQ(scene.components(), 0);
}

TEST(TrackRecovery, ATrackedFrameEndsTheCount) {
  Scene scene;
  for (int i = 1; i <= 2; ++i) scene.show_dark(i);
  ASSERT_EQ(scene.show_street(3).state, TrackingState::kTracking);
  scene.odometry.restart(SE3());
  for (int i = 4; i <= 5; ++i) scene.show_dark(i);
  EXPECT_EQ(scene.components(), 0);
  scene.show_dark(6);
  EXPECT_EQ(scene.components(), 1);
}

TEST(TrackRecovery, ATurnedCameraStandsWhereItWas) {
  const SO3 R = SO3::exp({0, 0.2, 0});
  const PureRotation rotation{R, 1e-6 * Eigen::Matrix3d::Identity()};
  const SE3 T_match_before = pose({0, 0.1, 0}, {1, 0, 2});
  const LocatedFrame once = turned({KeyframeId(4), SE3()}, Matrix6d::Zero(), rotation, 0.02);
  EXPECT_EQ(once.match, KeyframeId(4));
  EXPECT_LT(error(once.T_match_query, SE3(R, {0, 0, 0})), 1e-12);
  EXPECT_NEAR(once.information(0, 0), 1 / (0.02 * 0.02), 1e-6);
  EXPECT_NEAR(once.information(5, 5), 1e6, 1e-3);
  // Of a pose that was uncertain, the tangent turns with the camera.
  Matrix6d covariance = Matrix6d::Zero();
  covariance(2, 2) = 0.3 * 0.3;  // along its optical axis
  const LocatedFrame twice = turned({KeyframeId(4), T_match_before}, covariance, rotation, 0.02);
  EXPECT_LT(error(twice.T_match_query, T_match_before * SE3(R, {0, 0, 0})), 1e-12);
  const Eigen::Vector3d along = R.inverse() * Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d position = twice.information.topLeftCorner<3, 3>();
  EXPECT_NEAR(along.dot(position * along), 1 / (0.3 * 0.3 + 0.02 * 0.02), 1e-6);
}

TEST(TrackRecovery, MotionOfOtherSensorsCarriesAFrameFromTheLastKeyframe) {
  Scene scene;
  MotionStep step;
  step.to_ns = 10'000'000'000;
  step.T_from_to = SE3(SO3(), Eigen::Vector3d(0, 0, 20));
  step.covariance = 0.04 * Matrix6d::Identity();
  scene.recovery.use_motion(std::make_shared<const MeasuredMotion>(std::vector<MotionStep>{step}));
  OdometryUpdate lost;
  lost.state = TrackingState::kLost;
  const auto at =
      scene.recovery.pose_without_tracking(Scene::dark(5), lost, scene.known(), scene.odometry);
  ASSERT_TRUE(at);
  EXPECT_EQ(at->match, KeyframeId(0));
  EXPECT_LT(error(at->T_match_query, SE3(SO3(), Eigen::Vector3d(0, 0, 10))), 1e-9);
  EXPECT_LT(error(scene.known().T_map_frame(*at),
                  scene.T_map_keyframe * SE3(SO3(), Eigen::Vector3d(0, 0, 10))),
            1e-9);
}

TEST(TrackRecovery, ARunThatIsTakenUpContinuesItsSegment) {
  Scene scene;
  scene.recovery.take_up(KeyframeId(0), 10, scene.known());
  EXPECT_LT(error(scene.recovery.T_map_last(), scene.T_map_keyframe), 1e-12);
  const auto link = scene.recovery.take_link(scene.odometry.map(), scene.mapper);
  ASSERT_TRUE(link);
  EXPECT_EQ(link->source, ConstraintSource::kOdometry);
  EXPECT_NEAR(link->information(0, 0) / 1e8, 1, 1e-9);  // 1e-5 of ten metres
  EXPECT_FALSE(scene.recovery.take_link(scene.odometry.map(), scene.mapper));  // it is used up
}

TEST(TrackRecovery, ASegmentThatBeginsLaterIsNoContinuation) {
  Scene scene;
  scene.recovery.take_up(KeyframeId(0), 10, scene.known());
  scene.show_street(1);
  const auto link = scene.recovery.take_link(scene.odometry.map(), scene.mapper);
  ASSERT_TRUE(link);
  EXPECT_EQ(link->source, ConstraintSource::kOther);
}

TEST(TrackRecovery, AComponentCanBeginAtOnce) {
  Scene scene;
  const SE3 T_map_last(SO3(), Eigen::Vector3d(4, 5, 6));
  scene.recovery.stands_at(T_map_last);
  scene.recovery.begin_component(FrameId(7), scene.odometry);
  EXPECT_TRUE(scene.odometry.map().empty());
  EXPECT_FALSE(scene.recovery.take_link(scene.odometry.map(), scene.mapper));
}

TEST(TrackRecovery, AComponentApartWaitsForItsBeginning) {
  Scene scene;
  scene.recovery.begin_apart(FrameId(1), scene.odometry);
  // Frames are not counted as lost for as long as a loss may last: three and three frames.
  for (int i = 1; i <= 5; ++i) scene.show_dark(i);
  EXPECT_EQ(scene.components(), 1);
  scene.show_dark(6);
  EXPECT_EQ(scene.components(), 2);
}

TEST(TrackRecovery, AComponentApartThatHasBegunWaitsNoLonger) {
  Scene scene;
  scene.recovery.begin_apart(FrameId(1), scene.odometry);
  ASSERT_EQ(scene.show_street(1).state, TrackingState::kTracking);
  scene.odometry.restart(SE3());
  for (int i = 2; i <= 4; ++i) scene.show_dark(i);
  EXPECT_EQ(scene.components(), 2);
}

}  // namespace track_recovery_test
}  // namespace placegraph
