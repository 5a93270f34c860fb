#include <gtest/gtest.h>
#include <placegraph/pipeline/places/place_reach.h>

#include <numbers>

#include "tests/unit/pipeline/places/row_of_places.h"

namespace placegraph {
namespace place_reach_test {

using namespace test;

TEST(PlaceReach, TheEarlierPlaceIsTheNearestInReachThatLooksTheSameWay) {
  // 0 .. 3 once around a square of 5 m sides; 4 is back at 0 with an error of 1 m.
  KeyframeChain chain;
  PlacePartition partition;
  const SE3 side = pose({0, std::numbers::pi / 2, 0}, {0, 0, 5});
  SE3 T_map_this = pose({0.1, 0, 0}, {1, 1, 1});
  for (int i = 0; i < 5; ++i, T_map_this = T_map_this * side) {
    chain.add(KeyframeId(i), i == 0 ? std::nullopt : std::optional(link(i - 1, side)));
    partition.found(KeyframeId(i), Sim3(T_map_this * pose({0, 0, 0}, {i == 4 ? 1.0 : 0, 0, 0})), 0,
                    3);
  }
  const Sim3 S_map_here = partition.state_of(KeyframeId(4)).S_map_place;
  const auto earlier = [&](const Sim3& S, double reach) {
    return earlier_place_in_reach(chain, partition, {}, KeyframeId(4), S, reach);
  };
  EXPECT_EQ(earlier(S_map_here, 3), PlaceId(0));
  EXPECT_FALSE(earlier(S_map_here, 0.9));
  EXPECT_FALSE(earlier(S_map_here * Sim3(pose({0, 0.4, 0}, {0, 0, 0})), 3));           // 23 deg
  EXPECT_EQ(earlier(S_map_here * Sim3(pose({0, 0.3, 0}, {0, 0, 0})), 3), PlaceId(0));  // 17 deg
  // A path of 20 m that leads no further than twice the reach is no way round.
  EXPECT_FALSE(earlier(S_map_here, 10.1));
  // No place is earlier than the first.
  EXPECT_FALSE(earlier_place_in_reach(chain, partition, {}, KeyframeId(0),
                                      partition.state_of(KeyframeId(0)).S_map_place, 3));
}

TEST(PlaceReach, OfTwoEarlierPlacesInReachTheNearerOneCounts) {
  KeyframeChain chain;
  PlacePartition partition;
  const double x[] = {0, 1, 0.2};
  for (int i = 0; i < 3; ++i) {  // three runs of tracking, so that no short path joins them
    chain.add(KeyframeId(i), std::nullopt);
    partition.found(KeyframeId(i), Sim3(SO3(), Eigen::Vector3d(x[i], 0, 0), 1), 0, 3);
  }
  EXPECT_EQ(earlier_place_in_reach(chain, partition, {}, KeyframeId(2),
                                   partition.state_of(KeyframeId(2)).S_map_place, 3),
            PlaceId(0));
}

TEST(PlaceReach, AKeyframeWithinReachOfTheAnchorBelongsToItsPart) {
  Row row;
  const auto in_reach = [&](const SE3& T_4_this, double median_depth) {
    Row other = row;
    other.chain.add(KeyframeId(5), link(4, T_4_this));
    return in_reach_of_segment(other.chain, other.partition, {}, {}, KeyframeId(5), median_depth);
  };
  EXPECT_TRUE(in_reach(pose({0, 0, 0}, {0, 0, 2.9}), 10));
  EXPECT_FALSE(in_reach(pose({0, 0, 0}, {0, 0, 3.1}), 10));
  EXPECT_FALSE(in_reach(pose({0, 0, 0}, {0, 0, 2.9}), 9));
  EXPECT_TRUE(in_reach(pose({0, 0.34, 0}, {0, 0, 1}), 10));   // 19.5 deg
  EXPECT_FALSE(in_reach(pose({0, 0.36, 0}, {0, 0, 1}), 10));  // 20.6 deg
}

}  // namespace place_reach_test
}  // namespace placegraph
