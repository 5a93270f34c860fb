#include <gtest/gtest.h>
#include <placegraph/pipeline/odometry/first_frame_initializer.h>

#include "tests/support/scenes/window_world.h"
#include "tests/support/scripted_tracker.h"

namespace placegraph {
namespace first_frame_initializer_test {

using namespace test;
using Calls = std::vector<std::string>;

struct Beginning {
  StageTimes times;
  Calibration calibration = with_baseline();
  ScriptedTracker tracker;
  LocalMapping mapping{{}, calibration, {}, times};
  LocalMap map{{}, calibration.camera, Scale::kMetric};
  FirstFrameInitializer initializer{tracker, {}};
  SE3 T_odom_start{SO3::exp({0, 0.4, 0}), Eigen::Vector3d(3, 1, -2)};

  Beginning() {
    initializer.restart(T_odom_start);
    tracker.observation = [](const RectificationError&, LocalMap& of) {
      of.window().add_landmark(LandmarkId(of.newest().value()), {0, 0, 8});
    };
  }
  static Calibration with_baseline() {
    Calibration c;
    c.camera = window_camera();
    c.baseline_m = 0.5;
    return c;
  }
  Initialization add(std::int64_t id, const std::optional<SE3>& T_odom_cam_known = {}) {
    Frame frame;
    frame.id = FrameId(id);
    return initializer.add(frame, T_odom_cam_known, map, mapping);
  }
};

TEST(FirstFrameInitializer, BeginsWithItsFirstFrameAtTheGivenPose) {
  Beginning b;
  const Initialization begun = b.add(5);
  EXPECT_EQ(begun.state, TrackingState::kTracking);
  ASSERT_EQ(begun.keyframes.size(), 1u);
  EXPECT_EQ(begun.keyframes[0].id, KeyframeId(0));
  EXPECT_EQ(begun.keyframes[0].frame.id, FrameId(5));
  EXPECT_TRUE(begun.posed.empty());
  EXPECT_FALSE(begun.T_last_cur);  // a single frame shows no velocity
  EXPECT_LT((b.map.pose(KeyframeId(0)).inverse() * b.T_odom_start).log().norm(), 1e-12);
  EXPECT_EQ(b.tracker.asked.front(), "see_first");
}

TEST(FirstFrameInitializer, NoViewEverWaitsForAnother) {
  Beginning b;
  EXPECT_FALSE(b.initializer.started());
  b.tracker.shows_a_keyframe = false;
  EXPECT_EQ(b.add(0).state, TrackingState::kInitializing);
  EXPECT_FALSE(b.initializer.started());
}

TEST(FirstFrameInitializer, AFrameWithoutSurfacesLeavesTheMapEmpty) {
  Beginning b;
  b.tracker.shows_a_keyframe = false;
  const Initialization pending = b.add(0);
  EXPECT_EQ(pending.state, TrackingState::kInitializing);
  EXPECT_EQ(pending.outcome.reason, "no surface to begin with");
  EXPECT_FALSE(pending.is_reference);
  EXPECT_TRUE(b.map.empty());
  EXPECT_EQ(b.tracker.asked, (Calls{"see_first", "prepare", "reset"}));
}

TEST(FirstFrameInitializer, AKeyframeThatTheTrackerRefusesIsTakenBack) {
  Beginning b;
  b.map.restart(Scale::kMetric, 9);
  b.tracker.begins = Outcome::failure(Outcome::Code::kTooFewData, "3 of 90 points");
  const Initialization pending = b.add(0);
  EXPECT_EQ(pending.state, TrackingState::kInitializing);
  EXPECT_EQ(pending.outcome.reason, "3 of 90 points");
  EXPECT_TRUE(pending.keyframes.empty());
  EXPECT_TRUE(b.map.empty());
  EXPECT_TRUE(b.map.window().landmarks().empty());
  EXPECT_EQ(b.map.median_depth(), 9);  // not the depth that the refused keyframe saw
  EXPECT_EQ(b.tracker.asked.back(), "reset");
  b.tracker.begins = Outcome::ok();
  const Initialization begun = b.add(1);
  ASSERT_EQ(begun.state, TrackingState::kTracking);
  EXPECT_EQ(begun.keyframes[0].id, KeyframeId(0));  // the refused one has left no gap
}

TEST(FirstFrameInitializer, AFrameThatIsRecognizedStillBeginsAtItsGivenPose) {
  Beginning b;
  const SE3 T_known(SO3(), Eigen::Vector3d(50, 0, 0));
  ASSERT_EQ(b.add(0, T_known).state, TrackingState::kTracking);
  EXPECT_LT(distance_m(b.map.pose(KeyframeId(0)), b.T_odom_start), 1e-12);
}

TEST(Initialization, IsAnUpdateOfTheOdometry) {
  Initialization pending =
      Initialization::pending(Outcome::failure(Outcome::Code::kTooFewData, "too dark"));
  pending.is_reference = true;
  pending.T_odom_reference = SE3(SO3(), Eigen::Vector3d(1, 2, 3));
  pending.rotation = PureRotation{SO3::exp({0, 0.1, 0}), Eigen::Matrix3d::Identity()};
  pending.posed = {{FrameId(3), SE3()}};
  const OdometryUpdate update = pending.update();
  EXPECT_EQ(update.state, TrackingState::kInitializing);
  EXPECT_EQ(update.outcome.reason, "too dark");
  EXPECT_TRUE(update.reference);
  EXPECT_EQ(update.T_odom_cam.translation(), Eigen::Vector3d(1, 2, 3));
  ASSERT_TRUE(update.rotation);
  EXPECT_NEAR(update.rotation->R_before_cam.log().y(), 0.1, 1e-12);
  EXPECT_EQ(update.posed_again.size(), 1u);
}

}  // namespace first_frame_initializer_test
}  // namespace placegraph
