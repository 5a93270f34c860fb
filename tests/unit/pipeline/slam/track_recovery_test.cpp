#include <gtest/gtest.h>
#include <placegraph/pipeline/slam/track_recovery.h>

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
  TrackRecovery recovery{{3, 0.002}, {}};
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
  static OdometryUpdate lost() {
    OdometryUpdate update;
    update.state = TrackingState::kLost;
    return update;
  }
};
double error(const SE3& a, const SE3& b) { return (a.inverse() * b).log().norm(); }

TEST(TrackRecovery, IsNeededWhereTrackingIsLostAndWhereAFrameWaitsInVain) {
  Scene scene;
  OdometryUpdate update;
  EXPECT_TRUE(scene.recovery.needed(update, scene.known()));  // waits, and nothing joins it
  update.state = TrackingState::kTracking;
  EXPECT_FALSE(scene.recovery.needed(update, scene.known()));
  EXPECT_TRUE(scene.recovery.needed(Scene::lost(), scene.known()));
  const TrajectoryRecorder nothing;
  EXPECT_FALSE(scene.recovery.needed({}, {scene.closer, scene.mapper, nothing}));
}

TEST(TrackRecovery, APureRotationAnchorsTheNextSegmentAtTheLastKeyframe) {
  Scene scene;
  OdometryUpdate update = Scene::lost();
  const SO3 R = SO3::exp({0, 0.2, 0});
  update.rotation = PureRotation{R, 1e-6 * Eigen::Matrix3d::Identity()};
  (void)scene.recovery.restart(Scene::dark(1), std::nullopt, update, scene.known(), scene.odometry);
  const auto link = scene.recovery.take_link(scene.odometry.map(), scene.mapper);
  ASSERT_TRUE(link);
  EXPECT_EQ(link->from, KeyframeId(0));
  EXPECT_LT(error(link->T_from_this, SE3(R, {0, 0, 0})), 1e-12);
  EXPECT_EQ(link->source, ConstraintSource::kOther);
  // Ten metres away, 0.002 rad of a translation pass for a rotation.
  EXPECT_NEAR(link->information(0, 0), 1 / (0.02 * 0.02), 1);
  EXPECT_NEAR(link->information(5, 5), 1e6, 1);
  EXPECT_FALSE(scene.recovery.take_link(scene.odometry.map(), scene.mapper));  // it is used up
}

TEST(TrackRecovery, BeginsANewComponentAfterTooManyLostFrames) {
  Scene scene;
  for (int i = 1; i <= 3; ++i)
    (void)scene.recovery.restart(Scene::dark(i), std::nullopt, Scene::lost(), scene.known(),
                                 scene.odometry);
  EXPECT_FALSE(scene.recovery.take_link(scene.odometry.map(), scene.mapper));
  const StreetDataset street(1);
  Frame seen = street.frame(0, Sensor::kStereo);
  seen.id = FrameId(9);
  const OdometryUpdate begun = scene.odometry.add_frame(seen);
  ASSERT_EQ(begun.state, TrackingState::kTracking);
  EXPECT_LT(error(begun.T_odom_cam, scene.T_map_keyframe), 1e-9);  // where the last pose was
}

TEST(TrackRecovery, ATrackedFrameEndsTheCount) {
  Scene scene;
  for (int i = 1; i <= 2; ++i)
    (void)scene.recovery.restart(Scene::dark(i), std::nullopt, Scene::lost(), scene.known(),
                                 scene.odometry);
  scene.recovery.tracked();
  scene.odometry.restart(SE3());
  (void)scene.recovery.restart(Scene::dark(3), std::nullopt, Scene::lost(), scene.known(),
                               scene.odometry);
  const StreetDataset street(1);
  EXPECT_LT(error(scene.odometry.add_frame(street.frame(0, Sensor::kStereo)).T_odom_cam, SE3()),
            1e-9);  // nothing has begun anew
}

TEST(TrackRecovery, MotionOfOtherSensorsCarriesAFrameFromTheLastKeyframe) {
  Scene scene;
  MotionStep step;
  step.to_ns = 10'000'000'000;
  step.T_from_to = SE3(SO3(), Eigen::Vector3d(0, 0, 20));
  step.covariance = 0.04 * Matrix6d::Identity();
  scene.recovery.use_motion(std::make_shared<const MeasuredMotion>(std::vector<MotionStep>{step}));
  const auto at = scene.recovery.pose_without_tracking(Scene::dark(5), std::nullopt, Scene::lost(),
                                                       scene.known(), scene.odometry);
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
}

TEST(TrackRecovery, ASegmentThatBeginsLaterIsNoContinuation) {
  Scene scene;
  scene.recovery.take_up(KeyframeId(0), 10, scene.known());
  (void)scene.recovery.expect(Scene::dark(1), scene.known(), scene.odometry);
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
  const OdometryUpdate waits;
  scene.recovery.begin_apart(FrameId(1), scene.odometry);
  for (int i = 1; i <= 4; ++i) {  // as long as a loss may last
    (void)scene.recovery.expect(Scene::dark(i), scene.known(), scene.odometry);
    EXPECT_EQ(scene.recovery.needed(waits, scene.known()), i > 3) << i;
  }
  scene.recovery.begin_apart(FrameId(5), scene.odometry);
  EXPECT_TRUE(scene.recovery.needed(Scene::lost(), scene.known()));
  scene.recovery.tracked();  // it has begun
  EXPECT_TRUE(scene.recovery.needed(waits, scene.known()));
}

}  // namespace track_recovery_test
}  // namespace placegraph
