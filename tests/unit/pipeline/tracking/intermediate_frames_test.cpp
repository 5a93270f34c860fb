#include <gtest/gtest.h>
#include <placegraph/pipeline/tracking/intermediate_frames.h>

#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace intermediate_frames_test {

using namespace test;

/// Two keyframes of a map with exact landmarks, and a frame between them.
struct Scene {
  Camera camera = window_camera();
  LocalMap map{{}, camera, Scale::kMetric};
  SE3 T_odom_keyframe{SO3::exp({0, 0.1, 0}), Eigen::Vector3d(1, 0, 2)};
  SE3 T_keyframe_cam{SO3::exp({0.01, -0.02, 0}), Eigen::Vector3d(0.05, 0, 0.3)};
  std::vector<std::pair<LandmarkId, Eigen::Vector2d>> px;

  explicit Scene(int landmarks = 40) {
    map.add_keyframe(T_odom_keyframe);
    map.add_keyframe(T_odom_keyframe * T_keyframe_cam * T_keyframe_cam);
    Random random(7);
    for (int i = 0; i < landmarks; ++i) {
      const Eigen::Vector3d p_cam(random.uniform(-3, 3), random.uniform(-1, 1),
                                  random.uniform(5, 15));
      map.window().add_landmark(LandmarkId(i), T_odom_keyframe * T_keyframe_cam * p_cam);
      px.emplace_back(i, *camera.project(p_cam));
    }
  }
  IntermediateFrames frames() const { return IntermediateFrames({}, camera); }
};

TEST(IntermediateFrames, ArePosedByTheLandmarksAsTheyAreKnownNow) {
  const Scene scene;
  IntermediateFrames frames = scene.frames();
  const SE3 wrong = scene.T_keyframe_cam * SE3(SO3::exp({0, 0.01, 0}), {0.1, 0.05, -0.1});
  frames.remember({FrameId(5), wrong, scene.px, std::nullopt});
  const auto posed = frames.repose(scene.map, KeyframeId(0), 1);
  ASSERT_EQ(posed.size(), 1u);
  EXPECT_EQ(posed[0].first, FrameId(5));
  EXPECT_LT((posed[0].second.inverse() * scene.T_odom_keyframe * scene.T_keyframe_cam).log().norm(),
            1e-6);
  EXPECT_TRUE(frames.repose(scene.map, KeyframeId(0), 1).empty());  // they are forgotten
}

TEST(IntermediateFrames, AreCorrectedByErrorsThatHaveBecomeKnown) {
  const Scene scene;
  RgbdErrors::Vector values = RgbdErrors::Vector::Zero();
  values[RgbdErrors::kFocal] = 0.01;
  values[RgbdErrors::kReadout] = 0.02;
  const RgbdErrors errors(values);
  Vector6d twist;
  twist << 0, 0, 1, 0, 0.8, 0;
  auto seen = scene.px;
  const SE3 T_cam_odom = (scene.T_odom_keyframe * scene.T_keyframe_cam).inverse();
  for (auto& [id, px] : seen)
    px += errors.displacement_px(scene.camera, px, T_cam_odom * *scene.map.window().landmark(id),
                                 twist);
  const auto error_with = [&](const RgbdErrors& known) {
    IntermediateFrames frames = scene.frames();
    frames.remember({FrameId(5), scene.T_keyframe_cam, seen, std::nullopt, {RgbdErrors(), twist}});
    const auto posed = frames.repose(scene.map, KeyframeId(0), 1, known);
    return (T_cam_odom * posed.at(0).second).log().norm();
  };
  EXPECT_GT(error_with(RgbdErrors()), 0.01);
  EXPECT_LT(error_with(errors), 0.1 * error_with(RgbdErrors()));
}

TEST(IntermediateFrames, StayAsTheyWereWithoutEnoughLandmarks) {
  const Scene scene(11);  // 12 are needed
  IntermediateFrames frames = scene.frames();
  frames.remember({FrameId(5), scene.T_keyframe_cam, scene.px, std::nullopt});
  EXPECT_TRUE(frames.repose(scene.map, KeyframeId(0), 1).empty());
}

TEST(IntermediateFrames, BeginWithinReachAfterTheMapHasBeenRescaled) {
  const Scene scene;
  IntermediateFrames frames = scene.frames();
  // When it was remembered, lengths were a hundred times as long: beyond all landmarks.
  frames.remember({FrameId(5), scene.T_keyframe_cam.scaled(100), scene.px, std::nullopt});
  const auto posed = frames.repose(scene.map, KeyframeId(0), 0.01);
  ASSERT_EQ(posed.size(), 1u);
  EXPECT_LT((posed[0].second.inverse() * scene.T_odom_keyframe * scene.T_keyframe_cam).log().norm(),
            1e-6);
}

TEST(IntermediateFrames, ShareTheDriftOfTheirTracksEvenly) {
  const Scene scene;
  IntermediateFrames frames = scene.frames();
  // Until the keyframe a track drifts by (4, 0) px: by one quarter in each of three frames and it.
  const Eigen::Vector2d drift_px(4, 0);
  for (int k = 1; k <= 3; ++k) {
    auto drifted = scene.px;
    for (auto& [id, px] : drifted) px -= k / 4.0 * drift_px;
    frames.remember({FrameId(k), scene.T_keyframe_cam, drifted, std::nullopt});
  }
  std::map<LandmarkId, Eigen::Vector2d> drift;
  for (const auto& [id, px] : scene.px) drift[id] = drift_px;
  frames.correct_drift(drift);
  const auto posed = frames.repose(scene.map, KeyframeId(0), 1);
  ASSERT_EQ(posed.size(), 3u);
  for (const auto& [frame, T_odom_cam] : posed)
    EXPECT_LT((T_odom_cam.inverse() * scene.T_odom_keyframe * scene.T_keyframe_cam).log().norm(),
              1e-6);
}

TEST(IntermediateFrames, FollowTheManhattanFrameThatTheySaw) {
  Scene scene;
  scene.map.window().add_manhattan_frame(ManhattanFrameId(3), SO3());
  IntermediateFrames frames = scene.frames();
  const SO3 R_odom_cam =
      (scene.T_odom_keyframe * scene.T_keyframe_cam).rotation() * SO3::exp({0, 0, 0.02});
  const ManhattanCue::RotationEstimate manhattan_rotation{ManhattanFrameId(3), R_odom_cam.inverse(),
                                                          1e12 * Eigen::Matrix3d::Identity()};
  frames.remember({FrameId(5), scene.T_keyframe_cam, scene.px, manhattan_rotation});
  const auto posed = frames.repose(scene.map, KeyframeId(0), 1);
  ASSERT_EQ(posed.size(), 1u);
  EXPECT_LT((posed[0].second.rotation().inverse() * R_odom_cam).log().norm(), 1e-4);
}

}  // namespace intermediate_frames_test
}  // namespace placegraph
