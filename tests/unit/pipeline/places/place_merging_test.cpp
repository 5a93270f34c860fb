#include <numbers>

#include <gtest/gtest.h>
#include <placegraph/pipeline/places/place_mapper.h>
#include <placegraph/pipeline/places/place_merging.h>

#include "tests/support/place_links.h"

namespace placegraph {
namespace place_merging_test {

using namespace test;

const SE3 kSide = pose({0, std::numbers::pi / 2, 0}, {0, 0, 5});

/// Twice around a square of 5 m sides, exactly: keyframes 4..7 are back at 0..3.
PlaceMapper two_rounds() {
  PlaceMapper mapper({});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  for (int i = 1; i < 8; ++i)
    mapper.add_keyframe(KeyframeId(i), link(i - 1, kSide, 0.1, 0.01), {}, kDepth_m);
  return mapper;
}

TEST(PlaceMerging, MergesWhatTheMapKnowsToBeOneThoughNoLoopShowsIt) {
  PlaceMapper without = two_rounds();
  EXPECT_EQ(optimized(without).places.size(), 8u);  // odometry alone is no evidence
  PlaceMapper mapper = two_rounds();
  mapper.add_loop(loop(4, 0, SE3(), 0.01, 0.001));
  mapper.add_loop(loop(6, 2, SE3(), 0.01, 0.001));
  EXPECT_EQ(optimized(mapper).places.size(), 4u);
  for (int i = 4; i < 8; ++i) EXPECT_EQ(mapper.place_of(KeyframeId(i)), PlaceId(i - 4)) << i;
}

TEST(PlaceMerging, KeepsNeighboursApartThatAreWithinReachOfEachOther) {
  // The depth falls: places are founded 1 m apart within the 3 m of the first.
  PlaceMapper mapper({});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  for (int i = 1; i <= 4; ++i)
    mapper.add_keyframe(KeyframeId(i),
                        link(i - 1, i == 1 ? kLong : pose({0, 0, 0}, {0, 0, 1}), 0.01, 0.001), {},
                        0.2 * kDepth_m);
  mapper.add_loop(loop(4, 1, pose({0, 0, 0}, {0, 0, 3}), 0.01, 0.001));
  EXPECT_EQ(optimized(mapper).places.size(), 5u);
}

/// Five metres ahead eight times; a false loop says that the end is the beginning, while nothing is
/// known of the way yet.
PlaceMapper fooled() {
  PlaceMapper mapper({});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  for (int i = 1; i <= 8; ++i)
    mapper.add_keyframe(KeyframeId(i), link(i - 1, pose({0, 0, 0}, {0, 0, 5}), 20, 0.001), {},
                        kDepth_m);
  mapper.add_loop(loop(8, 0, SE3(), 0.01, 0.001));
  return mapper;
}

TEST(PlaceMerging, IsUndoneWhenTheEvidenceFalls) {
  PlaceMapper mapper = fooled();
  ASSERT_EQ(optimized(mapper).places.size(), 8u);
  ASSERT_EQ(mapper.place_of(KeyframeId(8)), PlaceId(0));
  // The way turns out to be known to centimetres.
  for (int i = 1; i <= 8; ++i) mapper.inform_link(KeyframeId(i), information_of(0.05, 0.001));
  const PlaceGraph graph = optimized(mapper);
  ASSERT_EQ(graph.places.size(), 9u);
  EXPECT_NE(mapper.place_of(KeyframeId(8)), PlaceId(0));
  EXPECT_EQ(graph.find(mapper.place_of(KeyframeId(8)))->anchor_keyframe, KeyframeId(8));
  EXPECT_EQ(graph.find(mapper.place_of(KeyframeId(8)))->members.size(), 1u);
  EXPECT_EQ(graph.find(PlaceId(0))->members.size(), 1u);
  // The loop is an edge again, and its kernel holds it off.
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(8)), pose({0, 0, 0}, {0, 0, 40})), 0.1);
  (void)optimized(mapper);
  EXPECT_EQ(mapper.place_graph().places.size(), 9u);  // and it stays undone
}

TEST(PlaceMerging, LeavesTrueOnesTogetherWhenTheWayIsKnownBetter) {
  PlaceMapper mapper = two_rounds();
  mapper.add_loop(loop(4, 0, SE3(), 0.01, 0.001));
  ASSERT_EQ(optimized(mapper).places.size(), 4u);
  for (int i = 1; i < 8; ++i) mapper.inform_link(KeyframeId(i), information_of(0.01, 0.001));
  EXPECT_EQ(optimized(mapper).places.size(), 4u);
}

/// Five keyframes 5 m apart, each a place; the last is back at the first,
/// and the map has it at `T_0_4` from there.
struct ClosedRow {
  KeyframeChain chain;
  PlacePartition partition;
  std::vector<Loop> loops{loop(4, 0, SE3(), 0.1, 0.01)};

  explicit ClosedRow(const SE3& T_0_4 = {}) {
    for (int i = 0; i <= 4; ++i) {
      chain.add(KeyframeId(i),
                i == 0 ? std::nullopt : std::optional(link(i - 1, pose({0, 0, 0}, {0, 0, 5}))));
      partition.found(KeyframeId(i), Sim3(i == 4 ? T_0_4 : pose({0, 0, 0}, {0, 0, 5.0 * i})), 0, 3);
    }
  }
  std::size_t mergers(double sigma_m = 0.1, KeyframeId first_open = kNoneOpen) const {
    const auto covariance = [&](PlaceId from, PlaceId to) {
      EXPECT_LT(from, to);
      Matrix7d result = Matrix7d::Zero();
      result(1, 1) = sigma_m * sigma_m;
      return result;
    };
    return find_mergers(chain, partition, loops, {}, covariance, first_open).size();
  }
};

TEST(PlaceMerging, TwoPlacesAreOneIfALoopAgreesAndTheyAreInReachAndKnownWellEnough) {
  EXPECT_EQ(ClosedRow().mergers(), 1u);
  EXPECT_EQ(ClosedRow().mergers(0.29), 1u);  // a tenth of the reach of 3 m is 0.3 m
  EXPECT_EQ(ClosedRow().mergers(0.31), 0u);
  ClosedRow far(pose({0, 0, 0}, {3.1, 0, 0})), near(pose({0, 0, 0}, {2.9, 0, 0}));
  far.loops = {loop(4, 0, pose({0, 0, 0}, {3.1, 0, 0}), 0.1, 0.01)};
  near.loops = {loop(4, 0, pose({0, 0, 0}, {2.9, 0, 0}), 0.1, 0.01)};
  EXPECT_EQ(far.mergers(), 0u);
  EXPECT_EQ(near.mergers(), 1u);
  const SE3 rotated = pose({0, 0.36, 0}, {0, 0, 0});  // 20.6 deg
  ClosedRow other_way(rotated);
  other_way.loops = {loop(4, 0, rotated, 0.1, 0.01)};
  EXPECT_EQ(other_way.mergers(), 0u);
}

TEST(PlaceMerging, PlacesThatAreBeingRefinedWait) {
  EXPECT_EQ(ClosedRow().mergers(0.1, KeyframeId(4)), 0u);
  EXPECT_EQ(ClosedRow().mergers(0.1, KeyframeId(5)), 1u);
}

TEST(PlaceMerging, ALoopThatTheMapContradictsShowsNothing) {
  // The map itself shows that two places meet 1 m apart only along a long path between them.
  ClosedRow row(pose({0, 0, 0}, {1, 0, 0}));
  row.partition = {};
  for (int i = 0; i <= 4; ++i)
    row.partition.found(
        KeyframeId(i), Sim3(pose({0, 0, 0}, {i == 4 ? 1.0 : 0, 0, i == 4 ? 0 : 5.0 * i})), 0, 10.5);
  EXPECT_EQ(row.mergers(), 0u);  // 10 sigma, 20 m of path
  row.loops = {loop(4, 0, pose({0, 0, 0}, {1.1, 0, 0}), 0.1, 0.01)};
  EXPECT_EQ(row.mergers(), 1u);
}

TEST(PlaceMerging, APlaceTakesPartInOneMergerAtATime) {
  ClosedRow row;
  row.chain.add(KeyframeId(5), link(4, pose({0, 0, 0}, {0, 0, 5})));
  row.partition.found(KeyframeId(5), Sim3(pose({0, 0, 0}, {0.1, 0, 0})), 0, 3);
  row.loops.push_back(loop(5, 0, pose({0, 0, 0}, {0.1, 0, 0}), 0.1, 0.01));
  EXPECT_EQ(row.mergers(), 1u);
}

TEST(PlaceMerging, PlacesThatWereSeparatedAreNotMergedAgain) {
  ClosedRow row;
  row.partition.merge(PlaceId(0), PlaceId(4), Matrix7d::Zero());
  row.partition.separate(0);
  EXPECT_EQ(row.mergers(), 0u);
}

TEST(PlaceMerging, OdometryContradictsAMergerThatItsEdgesCannotReach) {
  // Sides of 5 m, known to 5 cm, on a straight line: 4 is 20 m from 0. Where the map has merged
  // them all the same, the edge 3 to 4 is off by 20 m.
  ClosedRow row;
  EXPECT_TRUE(contradicted_mergers(row.chain, row.partition).empty());
  row.partition.merge(PlaceId(0), PlaceId(4), 0.01 * Matrix7d::Identity());
  EXPECT_EQ(contradicted_mergers(row.chain, row.partition), std::vector<std::size_t>{0});
  // The same where odometry knows nothing of that side.
  row.chain.inform_link(KeyframeId(4), information_of(20, 1), 0);
  EXPECT_TRUE(contradicted_mergers(row.chain, row.partition).empty());
}

}  // namespace place_merging_test
}  // namespace placegraph
