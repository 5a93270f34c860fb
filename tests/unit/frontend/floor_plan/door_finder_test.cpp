#include <gtest/gtest.h>
#include <placegraph/frontend/floor_plan/door_finder.h>

#include <algorithm>

namespace placegraph {
namespace door_finder_test {

constexpr double kStep = WallProfile::kStep_m;

/// A wall of five metres that is seen everywhere.
WallProfile whole_wall() {
  WallProfile profile{{1, -1, 2, 0, 5}, 0};
  WallStep wall;
  wall.wall = wall.faced = true;
  profile.steps.assign(100, wall);
  return profile;
}

WallStep open_step() {
  WallStep step;
  step.open = step.faced = true;
  step.head = 2.0;
  return step;
}

/// `count` steps from `begin` on are `step`.
WallProfile with(WallProfile profile, std::size_t begin, std::size_t count, const WallStep& step) {
  std::fill_n(profile.steps.begin() + static_cast<std::ptrdiff_t>(begin), count, step);
  return profile;
}

std::vector<DoorPiece> between_walls(const WallProfile& profile) {
  return doors_of(profile, {}).between_walls;
}

TEST(DoorsOf, AWallWithoutAGapHasNone) {
  EXPECT_TRUE(between_walls(whole_wall()).empty());
  EXPECT_TRUE(doors_of(whole_wall(), {}).half_seen.empty());
}

TEST(DoorsOf, AGapWithAHeadThatRaysPassIsAnOpenDoor) {
  const auto doors = between_walls(with(whole_wall(), 30, 18, open_step()));
  ASSERT_EQ(doors.size(), 1U);
  EXPECT_EQ(doors[0].axis, 1);
  EXPECT_EQ(doors[0].sign, -1);
  EXPECT_FALSE(doors[0].closed);
  EXPECT_NEAR(doors[0].from_m, 30 * kStep, 1e-9);
  EXPECT_NEAR(doors[0].to_m, 48 * kStep, 1e-9);
  EXPECT_NEAR(doors[0].offset_m, 2, 1e-12);
  EXPECT_NEAR(doors[0].head_m, 2, 1e-12);
}

TEST(DoorsOf, WhatIsNoWiderOrNarrowerThanDoorsAreIsOne) {
  EXPECT_TRUE(between_walls(with(whole_wall(), 30, 10, open_step())).empty());   // 0.5 m
  EXPECT_FALSE(between_walls(with(whole_wall(), 30, 12, open_step())).empty());  // 0.6 m
  EXPECT_FALSE(between_walls(with(whole_wall(), 30, 43, open_step())).empty());  // 2.15 m
  EXPECT_TRUE(between_walls(with(whole_wall(), 30, 46, open_step())).empty());   // 2.3 m
}

TEST(DoorsOf, AGapThatGoesOnAboveIsNone) {
  WallStep step = open_step();
  step.head = 2.6;
  EXPECT_TRUE(between_walls(with(whole_wall(), 30, 18, step)).empty());
  step = open_step();
  step.over = true;
  EXPECT_TRUE(between_walls(with(whole_wall(), 30, 18, step)).empty());
}

TEST(DoorsOf, WithoutAHeadOnlyWhereTheCameraWentThrough) {
  WallStep step = open_step();
  step.head.reset();
  WallProfile profile = with(whole_wall(), 30, 18, step);
  EXPECT_TRUE(between_walls(profile).empty());
  profile.crossed_m = {3.9};  // beside it
  EXPECT_TRUE(between_walls(profile).empty());
  profile.crossed_m = {1.9};
  ASSERT_EQ(between_walls(profile).size(), 1U);
  EXPECT_EQ(between_walls(profile)[0].head_m, 0);
  // Wider ones are passages of another kind.
  profile = with(whole_wall(), 30, 30, step);
  profile.crossed_m = {1.9};
  EXPECT_TRUE(between_walls(profile).empty());
}

TEST(DoorsOf, ALeafBehindTheSurfaceIsAClosedDoorInTheSurface) {
  WallStep leaf;
  leaf.recess = leaf.faced = true;
  leaf.head = 2.0;
  leaf.behind_m = 0.05;
  const auto doors = between_walls(with(whole_wall(), 30, 18, leaf));
  ASSERT_EQ(doors.size(), 1U);
  EXPECT_TRUE(doors[0].closed);
  EXPECT_NEAR(doors[0].offset_m, 2 + 0.05, 1e-12);  // seen from below: behind is up
  EXPECT_TRUE(between_walls(with(whole_wall(), 30, 34, leaf)).empty());  // 1.7 m: no leaf
  leaf.head.reset();
  EXPECT_TRUE(between_walls(with(whole_wall(), 30, 18, leaf)).empty());
}

TEST(DoorsOf, ADoorEndsWhereItsPassageEnds) {
  WallStep unseen;
  unseen.head = 2.0;
  WallProfile profile = with(whole_wall(), 20, 34, unseen);
  const auto doors = between_walls(with(profile, 32, 18, open_step()));
  ASSERT_EQ(doors.size(), 1U);
  EXPECT_NEAR(doors[0].from_m, 32 * kStep, 1e-9);  // 0.6 m of nothing before it
  EXPECT_NEAR(doors[0].to_m, 54 * kStep, 1e-9);    // and 0.2 m behind: up to the wall
}

TEST(DoorsOf, OneJambIsEnoughWhereTheCameraWentThrough) {
  for (const bool mirrored : {false, true}) {
    WallStep stops;
    stops.faced = true;
    WallProfile profile = with(whole_wall(), 40, 60, stops);  // no wall any more
    profile = with(profile, 40, 18, open_step());
    if (mirrored) std::reverse(profile.steps.begin(), profile.steps.end());
    EXPECT_TRUE(doors_of(profile, {}).half_seen.empty());
    profile.crossed_m = {mirrored ? 2.5 : 2.4};
    EXPECT_TRUE(doors_of(profile, {}).between_walls.empty());
    const auto doors = doors_of(profile, {}).half_seen;
    ASSERT_EQ(doors.size(), 1U);
    EXPECT_NEAR(doors[0].from_m, (mirrored ? 42 : 40) * kStep, 1e-9);
    EXPECT_NEAR(doors[0].to_m, (mirrored ? 60 : 58) * kStep, 1e-9);
    // Nothing in front of what stops rays: it may not be there.
    WallProfile unseen = profile;
    for (WallStep& step : unseen.steps) step.faced = step.open;
    EXPECT_TRUE(doors_of(unseen, {}).half_seen.empty());
  }
}

}  // namespace door_finder_test
}  // namespace placegraph
