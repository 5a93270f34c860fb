#include <numbers>

#include <gtest/gtest.h>
#include <placegraph/pipeline/places/place_mapper.h>

#include "tests/support/place_links.h"

namespace placegraph {
namespace {

using namespace test;

const SE3 kSide = pose({0, std::numbers::pi / 2, 0}, {0, 0, 5});

/// Twice around a square of 5 m sides, exactly: keyframes 4..7 are back at 0..3.
PlaceMapper two_rounds() {
  PlaceMapper mapper({});
  mapper.add_keyframe(0, std::nullopt, {}, kDepth_m);
  for (int i = 1; i < 8; ++i) mapper.add_keyframe(i, link(i - 1, kSide, 0.1, 0.01), {}, kDepth_m);
  return mapper;
}

TEST(PlaceMerging, MergesWhatTheMapKnowsToBeOneThoughNoLoopShowsIt) {
  PlaceMapper without = two_rounds();
  EXPECT_EQ(optimized(without).places.size(), 8u);  // odometry alone is no evidence
  PlaceMapper mapper = two_rounds();
  mapper.add_loop(loop(4, 0, SE3(), 0.01, 0.001));
  mapper.add_loop(loop(6, 2, SE3(), 0.01, 0.001));
  EXPECT_EQ(optimized(mapper).places.size(), 4u);
  for (int i = 4; i < 8; ++i) EXPECT_EQ(mapper.place_of(i), i - 4) << i;
}

TEST(PlaceMerging, KeepsNeighboursApartThatAreWithinReachOfEachOther) {
  // The depth falls: places are founded 1 m apart within the 3 m of the first.
  PlaceMapper mapper({});
  mapper.add_keyframe(0, std::nullopt, {}, kDepth_m);
  for (int i = 1; i <= 4; ++i)
    mapper.add_keyframe(i, link(i - 1, i == 1 ? kLong : pose({0, 0, 0}, {0, 0, 1}), 0.01, 0.001),
                        {}, 0.2 * kDepth_m);
  mapper.add_loop(loop(4, 1, pose({0, 0, 0}, {0, 0, 3}), 0.01, 0.001));
  EXPECT_EQ(optimized(mapper).places.size(), 5u);
}

/// Five metres ahead eight times; a false loop says that the end is the beginning, while nothing is
/// known of the way yet.
PlaceMapper fooled() {
  PlaceMapper mapper({});
  mapper.add_keyframe(0, std::nullopt, {}, kDepth_m);
  for (int i = 1; i <= 8; ++i)
    mapper.add_keyframe(i, link(i - 1, pose({0, 0, 0}, {0, 0, 5}), 20, 0.001), {}, kDepth_m);
  mapper.add_loop(loop(8, 0, SE3(), 0.01, 0.001));
  return mapper;
}

TEST(PlaceMerging, IsUndoneWhenTheEvidenceFalls) {
  PlaceMapper mapper = fooled();
  ASSERT_EQ(optimized(mapper).places.size(), 8u);
  ASSERT_EQ(mapper.place_of(8), 0);
  // The way turns out to be known to centimetres.
  for (int i = 1; i <= 8; ++i) mapper.inform_link(i, information_of(0.05, 0.001));
  const PlaceGraph graph = optimized(mapper);
  ASSERT_EQ(graph.places.size(), 9u);
  EXPECT_NE(mapper.place_of(8), 0);
  EXPECT_EQ(graph.find(mapper.place_of(8))->anchor_keyframe, 8);
  EXPECT_EQ(graph.find(mapper.place_of(8))->members.size(), 1u);
  EXPECT_EQ(graph.find(0)->members.size(), 1u);
  // The loop is an edge again, and its kernel holds it off.
  EXPECT_LT(distance_m(mapper.T_map_keyframe(8), pose({0, 0, 0}, {0, 0, 40})), 0.1);
  (void)optimized(mapper);
  EXPECT_EQ(mapper.place_graph().places.size(), 9u);  // and it stays undone
}

TEST(PlaceMerging, LeavesTrueOnesTogetherWhenTheWayIsKnownBetter) {
  PlaceMapper mapper = two_rounds();
  mapper.add_loop(loop(4, 0, SE3(), 0.01, 0.001));
  ASSERT_EQ(optimized(mapper).places.size(), 4u);
  for (int i = 1; i < 8; ++i) mapper.inform_link(i, information_of(0.01, 0.001));
  EXPECT_EQ(optimized(mapper).places.size(), 4u);
}

}  // namespace
}  // namespace placegraph
