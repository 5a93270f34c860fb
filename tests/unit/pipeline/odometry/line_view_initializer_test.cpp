#include <gtest/gtest.h>
#include <placegraph/pipeline/odometry/line_view_initializer.h>

#include "tests/support/scenes/beginning.h"
#include "tests/support/scenes/boards.h"

namespace placegraph {
namespace line_view_initializer_test {

using namespace test;

constexpr int kFrames = 16;

SE3 path(int i) { return pose({0, 0.01 * i, 0}, {-0.08 * i, -0.04 * i, 0.1 * i}); }

const std::vector<Frame>& drive() {
  static const std::vector<Frame> frames = boards_frames(kFrames, path);
  return frames;
}

const SE3 kStart = pose({0, 0.3, 0}, {2, 0, 1});

struct BoardsBeginning : Beginning<LineViewInitializer> {
  explicit BoardsBeginning(Scale scale = Scale::kArbitrary, std::optional<double> height_m = {})
      : Beginning(of_boards(height_m), "lines", scale, kStart) {}
  static Calibration of_boards(std::optional<double> height_m) {
    Calibration calibration;
    calibration.camera = boards_camera();
    calibration.camera_height_m = height_m;
    return calibration;
  }
  static const Frame& frame(int i) { return drive()[static_cast<std::size_t>(i)]; }
  Initialization add(int i, const std::optional<SE3>& T_odom_cam_known = {}) {
    return Beginning::add(frame(i), T_odom_cam_known);
  }
  Initialization add_dark(int i) { return Beginning::add_dark(frame(i)); }
  /// Frames from `first` on until the map begins; the last one's number in `last`.
  Initialization begin(int first, int* last = nullptr) {
    Initialization begun;
    for (int i = first; i < kFrames && begun.state != TrackingState::kTracking; ++i) {
      begun = add(i);
      if (last) *last = i;
    }
    return begun;
  }
};

TEST(LineViewInitializer, TheFirstFrameIsTheReference) {
  BoardsBeginning b;
  EXPECT_FALSE(b.initializer.started());
  const Initialization first = b.add(0);
  EXPECT_EQ(first.state, TrackingState::kInitializing);
  EXPECT_TRUE(first.is_reference);
  EXPECT_LT((first.T_odom_reference.inverse() * b.T_odom_start).log().norm(), 1e-12);
  EXPECT_TRUE(b.initializer.started());
  EXPECT_TRUE(b.map.empty());
}

TEST(LineViewInitializer, AnEmptyFrameIsNothingToBeginWith) {
  BoardsBeginning b;
  const Initialization dark = b.add_dark(0);
  EXPECT_EQ(dark.state, TrackingState::kInitializing);
  EXPECT_FALSE(dark.is_reference);
  EXPECT_NE(dark.outcome.reason.find("lines to follow"), std::string::npos);
  EXPECT_FALSE(b.initializer.started());
  EXPECT_TRUE(b.add(1).is_reference);
}

TEST(LineViewInitializer, SeveralViewsOfLinesBeginAMap) {
  BoardsBeginning b;
  int last = 0;
  const Initialization begun = b.begin(0, &last);
  ASSERT_EQ(begun.state, TrackingState::kTracking) << begun.outcome.reason;
  EXPECT_GE(last, 7);  // eight views are the fewest
  ASSERT_GE(begun.keyframes.size(), 3u);
  EXPECT_EQ(begun.keyframes.front().frame.id, FrameId(0));
  EXPECT_EQ(begun.keyframes.back().frame.id, FrameId(last));
  EXPECT_LT(distance_m(b.map.pose(KeyframeId(0)), b.T_odom_start), 1e-6);
  EXPECT_GE(begun.inliers, 9);
  // A map begins only where the ratio of the lengths of its two halves is known.
  const std::int64_t middle = static_cast<std::int64_t>(begun.keyframes.size() / 2);
  EXPECT_LT(
      sigma_log_length_ratio(b.map.window(), KeyframeId(0), KeyframeId(middle), b.map.newest()),
      0.021);
  EXPECT_FALSE(b.initializer.started());
  // Every frame is posed: as a keyframe, or between keyframes; up to the scale as it was driven.
  std::map<FrameId, SE3> posed(begun.posed.begin(), begun.posed.end());
  for (const NewKeyframe& keyframe : begun.keyframes)
    posed[keyframe.frame.id] = b.map.window().pose(keyframe.id);
  ASSERT_EQ(posed.size(), static_cast<std::size_t>(last + 1));
  const double scale =
      (posed[FrameId(last)].translation() - posed[FrameId(0)].translation()).norm() /
      distance_m(path(last), path(0));
  for (int i = 1; i <= last; ++i) {
    const SE3 found = posed[FrameId(0)].inverse() * posed[FrameId(i)],
              truth = path(0).inverse() * path(i);
    EXPECT_LT(angle_rad(found, truth), 0.01) << i;
    // A tenth of the way: lines along it tell little of how far it goes.
    EXPECT_LT((found.translation() / scale - truth.translation()).norm(),
              0.1 * distance_m(path(last), path(0)))
        << i;
  }
}

TEST(LineViewInitializer, TheVelocityIsTheMotionOverOneFrame) {
  BoardsBeginning b;
  const Initialization begun = b.begin(0);
  ASSERT_EQ(begun.state, TrackingState::kTracking);
  ASSERT_TRUE(begun.T_last_cur);
  const auto last = begun.keyframes.back(), before = begun.keyframes[begun.keyframes.size() - 2];
  SE3 T_before_last;
  for (FrameId i = before.frame.id; i < last.frame.id; ++i)
    T_before_last = T_before_last * *begun.T_last_cur;
  const SE3 truth = b.map.window().pose(before.id).inverse() * b.map.window().pose(last.id);
  EXPECT_LT((T_before_last.inverse() * truth).log().norm(), 1e-6);
}

TEST(LineViewInitializer, AnArbitraryMapSeesLinesAtTheUnknownDepth) {
  BoardsBeginning b;
  ASSERT_EQ(b.begin(0).state, TrackingState::kTracking);
  EXPECT_NEAR(b.map.median_depth(), LocalMap::kUnknownDepth, 0.4 * LocalMap::kUnknownDepth);
  EXPECT_FALSE(b.map.metric());
}

TEST(LineViewInitializer, AKnownMapGivesItsUnitByTheViewThatIsRecognized) {
  BoardsBeginning b(Scale::kFromMap);
  Initialization pending;
  int i = 0;
  for (; i < kFrames && pending.outcome.reason != "the scale of the map is unobservable"; ++i) {
    pending = b.add(i);
    ASSERT_NE(pending.state, TrackingState::kTracking) << i;
  }
  ASSERT_LT(i, kFrames);
  constexpr double kUnit = 3;  // of the map, where the drive is one of metres
  Initialization begun;
  for (; i < kFrames && begun.state != TrackingState::kTracking; ++i)
    begun = b.add(i, b.T_odom_start * (path(0).inverse() * path(i)).scaled(kUnit));
  ASSERT_EQ(begun.state, TrackingState::kTracking) << begun.outcome.reason;
  const double length = distance_m(b.map.pose(b.map.newest()), b.T_odom_start);
  EXPECT_NEAR(length / distance_m(path(i - 1), path(0)), kUnit, 0.05 * kUnit);
}

TEST(LineViewInitializer, AFrameWithoutTheLinesOfTheFirstViewTakesItsPlace) {
  BoardsBeginning b;
  (void)b.add(0);
  (void)b.add(1);
  const Initialization dark = b.add_dark(2);
  EXPECT_EQ(dark.state, TrackingState::kInitializing);
  EXPECT_FALSE(dark.is_reference);  // it shows nothing itself
  EXPECT_FALSE(b.initializer.started());
  const Initialization anew = b.add(3);
  EXPECT_TRUE(anew.is_reference);
  EXPECT_LT(distance_m(anew.T_odom_reference, b.T_odom_start), 1e-12);
}

TEST(LineViewInitializer, WhatWouldTellTheUnitOfAKnownMapIsLostWithItsView) {
  BoardsBeginning b(Scale::kFromMap);
  (void)b.add(0);
  (void)b.add(1);
  const Initialization lost = b.add_dark(2);
  EXPECT_EQ(lost.state, TrackingState::kLost);
  EXPECT_FALSE(lost.outcome.reason.empty());
  EXPECT_TRUE(b.map.empty());
}

TEST(LineViewInitializer, ACameraThatStandsWaitsAndLeavesTheMapEmpty) {
  BoardsBeginning b;
  Frame still = drive()[0];
  Initialization pending;
  for (int i = 0; i < 12; ++i) {
    still.id = FrameId(i);
    pending = b.initializer.add(still, {}, b.map, b.mapping);
    ASSERT_EQ(pending.state, TrackingState::kInitializing);
  }
  EXPECT_FALSE(pending.outcome.reason.empty());
  EXPECT_TRUE(b.map.empty());
  EXPECT_TRUE(b.map.window().lines().empty());
  EXPECT_EQ(b.map.median_depth(), LocalMap::kUnknownDepth);
}

TEST(LineViewInitializer, ARestartForgetsTheViewsAndMovesTheStart) {
  BoardsBeginning b;
  (void)b.add(0);
  const SE3 T_other = pose({0, 0, 0}, {-7, 0, 0});
  b.initializer.restart(T_other);
  b.tracker.reset();
  EXPECT_FALSE(b.initializer.started());
  const Initialization first = b.add(1);
  EXPECT_TRUE(first.is_reference);
  EXPECT_LT(distance_m(first.T_odom_reference, T_other), 1e-12);
}

}  // namespace line_view_initializer_test
}  // namespace placegraph
