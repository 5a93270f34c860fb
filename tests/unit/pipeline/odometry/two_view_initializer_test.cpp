#include <gtest/gtest.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/odometry/two_view_initializer.h>

#include "tests/support/scenes/beginning.h"
#include "tests/support/scenes/street.h"

namespace placegraph {
namespace two_view_initializer_test {

using namespace test;

constexpr int kStands = 4;  // frames of a camera that only rotates, before it moves

SE3 forward(int i) { return street_T_world_cam(i); }
/// Rotates in place, and drives on from there.
SE3 rotates_first(int i) {
  const SE3 T_rotated = pose({0, 0.03 * std::min(i, kStands), 0}, {0, -kStreetHeight_m, 0});
  return i <= kStands ? T_rotated : T_rotated * pose({0, 0, 0}, {0, 0, 0.4 * (i - kStands)});
}

const StreetDataset& drive() {
  static const StreetDataset dataset(6, 0, 0, false, forward);
  return dataset;
}
const StreetDataset& rotation_drive() {
  static const StreetDataset dataset(kStands + 7, 0, 0, false, rotates_first);
  return dataset;
}

const SE3 kStart = pose({0, 0.3, 0}, {2, 0, 1});

struct StreetBeginning : Beginning<TwoViewInitializer> {
  const StreetDataset& dataset;

  explicit StreetBeginning(const StreetDataset& d, Scale scale = Scale::kArbitrary)
      : Beginning(d.calibration(Sensor::kMono), "points", scale, kStart), dataset(d) {}
  Initialization add(int i, const std::optional<SE3>& T_odom_cam_known = {}) {
    return Beginning::add(dataset.frame(i, Sensor::kMono), T_odom_cam_known);
  }
  Initialization add_dark(int i) { return Beginning::add_dark(dataset.frame(i, Sensor::kMono)); }
};

TEST(TwoViewInitializer, TheFirstFrameIsTheReference) {
  StreetBeginning b(drive());
  EXPECT_FALSE(b.initializer.started());
  const Initialization first = b.add(0);
  EXPECT_EQ(first.state, TrackingState::kInitializing);
  EXPECT_TRUE(first.is_reference);
  EXPECT_LT((first.T_odom_reference.inverse() * b.T_odom_start).log().norm(), 1e-12);
  EXPECT_TRUE(b.initializer.started());
  EXPECT_TRUE(b.map.empty());
}

TEST(TwoViewInitializer, TwoViewsWithParallaxBeginAMap) {
  StreetBeginning b(drive());
  (void)b.add(0);
  const Initialization begun = b.add(1);
  ASSERT_EQ(begun.state, TrackingState::kTracking) << begun.outcome.reason;
  ASSERT_EQ(begun.keyframes.size(), 2u);
  EXPECT_EQ(begun.keyframes[0].frame.id, FrameId(0));
  EXPECT_EQ(begun.keyframes[1].frame.id, FrameId(1));
  EXPECT_LT(distance_m(b.map.pose(KeyframeId(0)), b.T_odom_start), 1e-9);
  const SE3 truth = forward(0).inverse() * forward(1);
  // Tracks of 0.25 px at 330 px, hundreds of them.
  EXPECT_LT(angle_rad(b.motion(), truth), 0.003);
  EXPECT_LT(angle_between(b.motion().translation(), truth.translation()), 0.05);
  EXPECT_GT(begun.inliers, 50);
  EXPECT_FALSE(b.initializer.started());
}

TEST(TwoViewInitializer, TheVelocityIsTheMotionOverOneFrame) {
  StreetBeginning b(rotation_drive());
  Initialization begun;
  int i = 0;
  for (; i < kStands + 7 && begun.state != TrackingState::kTracking; ++i) begun = b.add(i);
  ASSERT_EQ(begun.state, TrackingState::kTracking);
  ASSERT_TRUE(begun.T_last_cur);
  SE3 whole;
  for (int step = 0; step < i - 1; ++step) whole = whole * *begun.T_last_cur;
  EXPECT_LT((whole.inverse() * b.motion()).log().norm(), 1e-6);
}

TEST(TwoViewInitializer, AnArbitraryMapSeesThingsAtTheUnknownDepth) {
  StreetBeginning b(drive());
  (void)b.add(0);
  ASSERT_EQ(b.add(1).state, TrackingState::kTracking);
  EXPECT_NEAR(b.map.median_depth(), LocalMap::kUnknownDepth, 0.25 * LocalMap::kUnknownDepth);
}

TEST(TwoViewInitializer, AGuessedScaleTakesThingsToBeAsFarAwayAsBefore) {
  StreetBeginning unknown(drive()), guessed(drive());
  guessed.map.restart(Scale::kGuessed, 2.5);
  for (StreetBeginning* b : {&unknown, &guessed}) {
    (void)b->add(0);
    ASSERT_EQ(b->add(1).state, TrackingState::kTracking);
  }
  const double ratio =
      guessed.motion().translation().norm() / unknown.motion().translation().norm();
  EXPECT_NEAR(ratio, 2.5 / LocalMap::kUnknownDepth, 0.01 * ratio);
}

TEST(TwoViewInitializer, AKnownMapGivesItsUnitByTheViewThatIsRecognized) {
  StreetBeginning b(drive(), Scale::kFromMap);
  (void)b.add(0);
  const Initialization pending = b.add(1);
  EXPECT_EQ(pending.state, TrackingState::kInitializing);
  EXPECT_EQ(pending.outcome.reason, "the scale of the map is unobservable");
  EXPECT_TRUE(b.map.empty());
  const SE3 T_known = b.T_odom_start * pose({0, 0, 0}, {0, 0, 4});
  ASSERT_EQ(b.add(2, T_known).state, TrackingState::kTracking);
  // The bundle adjustment leaves the length where it begins, but for what its priors pull.
  EXPECT_NEAR(b.motion().translation().norm(), 4, 0.2);
}

TEST(TwoViewInitializer, ARotationIsNoBeginningButItsFramesArePosed) {
  StreetBeginning b(rotation_drive());
  (void)b.add(0);
  for (int i = 1; i <= kStands; ++i) {
    const Initialization pending = b.add(i);
    ASSERT_EQ(pending.state, TrackingState::kInitializing) << i;
    ASSERT_TRUE(pending.rotation) << i;
    const SO3 truth = rotates_first(0).rotation().inverse() * rotates_first(i).rotation();
    EXPECT_LT((pending.rotation->R_before_cam.inverse() * truth).log().norm(), 0.003) << i;
  }
  Initialization begun;
  int i = kStands + 1;
  for (; i < kStands + 7 && begun.state != TrackingState::kTracking; ++i) begun = b.add(i);
  ASSERT_EQ(begun.state, TrackingState::kTracking);
  std::map<FrameId, SE3> posed;  // later ones are better
  for (const PosedFrame& frame : begun.posed) posed[frame.first] = frame.second;
  for (int k = 1; k <= kStands; ++k) {
    ASSERT_TRUE(posed.contains(FrameId(k))) << k;
    const SO3 truth = rotates_first(0).rotation().inverse() * rotates_first(k).rotation();
    const SE3 found = b.T_odom_start.inverse() * posed[FrameId(k)];
    EXPECT_LT((found.rotation().inverse() * truth).log().norm(), 0.005) << k;
    EXPECT_LT(found.translation().norm(), 0.05 * b.motion().translation().norm()) << k;
  }
}

TEST(TwoViewInitializer, FramesFromBeforeAReferenceThatRotatedOutOfViewArePosed) {
  // It looks from along the street to a house front, and then drives on.
  static constexpr int kRotates = 9, kAll = 14;
  const auto path = [](int i) {
    return pose({0, 0.1 * std::min(i, kRotates), 0},
                {0, -kStreetHeight_m, 0.3 * std::max(0, i - kRotates)});
  };
  const StreetDataset looks_aside(kAll, 0, 0, false, path);
  StreetBeginning b(looks_aside);
  Initialization begun = b.add(0);
  std::int64_t reference = 0;
  for (int i = 1; i < kAll && begun.state != TrackingState::kTracking; ++i) {
    begun = b.add(i);
    if (begun.is_reference) {
      reference = i;
      EXPECT_TRUE(begun.rotation) << i;
    }
  }
  ASSERT_EQ(begun.state, TrackingState::kTracking) << begun.outcome.reason;
  ASSERT_GT(reference, 1);
  std::map<FrameId, SE3> posed;  // later ones are better
  for (const PosedFrame& frame : begun.posed) posed[frame.first] = frame.second;
  for (std::int64_t k = 1; k < reference; ++k) {
    ASSERT_TRUE(posed.contains(FrameId(k))) << k << " of " << reference;
    const SO3 truth = path(0).rotation().inverse() * path(static_cast<int>(k)).rotation();
    const SE3 found = b.T_odom_start.inverse() * posed[FrameId(k)];
    EXPECT_LT((found.rotation().inverse() * truth).log().norm(), 0.01) << k;
  }
}

TEST(TwoViewInitializer, AnotherFrameTakesThePlaceOfAReferenceThatIsOutOfView) {
  StreetBeginning b(drive());
  (void)b.add(0);
  const Initialization dark = b.add_dark(1);
  EXPECT_EQ(dark.state, TrackingState::kInitializing);
  EXPECT_FALSE(dark.is_reference);  // a dark frame is nothing to begin with either
  EXPECT_FALSE(b.initializer.started());
  const Initialization anew = b.add(2);
  EXPECT_TRUE(anew.is_reference);
  EXPECT_LT(distance_m(anew.T_odom_reference, b.T_odom_start), 1e-12);
  ASSERT_EQ(b.add(3).state, TrackingState::kTracking);
  EXPECT_TRUE(b.map.pose(KeyframeId(0)).translation().isApprox(b.T_odom_start.translation(), 1e-9));
}

TEST(TwoViewInitializer, KeepsItsReferenceOverAStepThatIsTooWideForATracker) {
  const auto path = [](int i) {
    return pose({0, 0.5 * i, 0}, {0.5 * i, -kStreetHeight_m, 0.2 * i});
  };
  const StreetDataset rotates(2, 0, 0, false, path);
  StreetBeginning b(rotates);
  (void)b.add(0);
  const Initialization second = b.add(1);
  EXPECT_FALSE(second.is_reference) << second.outcome.reason;
  if (second.state != TrackingState::kTracking) return;  // it may wait for a wider baseline
  EXPECT_LT(angle_rad(b.motion(), path(0).inverse() * path(1)), 0.02);
}

TEST(TwoViewInitializer, WhatWouldTellTheUnitOfAKnownMapIsLostWithItsView) {
  StreetBeginning b(drive(), Scale::kFromMap);
  (void)b.add(0);
  const Initialization lost = b.add_dark(1);
  EXPECT_EQ(lost.state, TrackingState::kLost);
  EXPECT_NE(lost.outcome.reason.find("points of the first view are left"), std::string::npos);
  EXPECT_TRUE(b.map.empty());
}

TEST(TwoViewInitializer, ARestartForgetsTheViewsAndMovesTheStart) {
  StreetBeginning b(drive());
  (void)b.add(0);
  const SE3 T_other = pose({0, 0, 0}, {-7, 0, 0});
  b.initializer.restart(T_other);
  b.tracker.reset();
  EXPECT_FALSE(b.initializer.started());
  const Initialization first = b.add(1);
  EXPECT_TRUE(first.is_reference);
  EXPECT_LT(distance_m(first.T_odom_reference, T_other), 1e-12);
}

}  // namespace two_view_initializer_test
}  // namespace placegraph
