#include <gtest/gtest.h>
#include <placegraph/pipeline/places/place_components.h>

#include "tests/unit/pipeline/places/row_of_places.h"

namespace placegraph {
namespace place_components_test {

using namespace test;

/// Two runs, each its own component: 0 and 1, 5 m apart; 2 and 3, too.
struct TwoComponents {
  KeyframeChain chain;
  PlacePartition partition;

  TwoComponents(bool first_known, bool second_known) {
    chain.add(KeyframeId(0), std::nullopt, first_known);
    partition.found(KeyframeId(0), Sim3(), 0, 3);
    chain.add(KeyframeId(1), link(0, kLong));
    partition.found(KeyframeId(1), Sim3(kLong), 0, 3);
    const SE3 T_map_2 = pose({0, 1, 0}, {50, 0, 0});
    chain.add(KeyframeId(2), std::nullopt, second_known);
    partition.found(KeyframeId(2), Sim3(T_map_2), 1, 3);
    chain.add(KeyframeId(3), link(2, kLong));
    partition.found(KeyframeId(3), Sim3(T_map_2 * kLong), 1, 3);
  }
  Sim3 S_map(std::int64_t keyframe) const {
    return partition.S_map_keyframe(chain, KeyframeId(keyframe));
  }
};

TEST(PlaceComponents, ALoopMovesTheYoungerComponentAsAWholeToWhereItSays) {
  for (const bool query_is_younger : {true, false}) {
    TwoComponents map(true, false);
    const Sim3 S_1_3(pose({0, -0.1, 0}, {1, 0, 2}).rotation(), {1, 0, 2}, 2.5);
    const Sim3 S_3_1 = S_1_3.inverse();
    Loop loop = query_is_younger ? scaled_loop(3, 1, rigid_part(S_1_3), 2.5)
                                 : scaled_loop(1, 3, rigid_part(S_3_1), 1 / 2.5);
    const Sim3 S_2_3 = map.S_map(2).inverse() * map.S_map(3);
    join_components(map.chain, {loop}, map.partition);
    EXPECT_EQ(map.partition.state_of(KeyframeId(3)).component, 0);
    EXPECT_EQ(map.partition.state_of(KeyframeId(2)).component, 0);
    EXPECT_LT(difference(map.S_map(1), Sim3(kLong)), kRounding);
    EXPECT_LT(difference(map.S_map(3), Sim3(kLong) * S_1_3), kRounding);
    EXPECT_LT(difference(map.S_map(2).inverse() * map.S_map(3), S_2_3), kRounding);
  }
}

TEST(PlaceComponents, AComponentTakesTheScaleThatOneOfItsPlacesKnows) {
  TwoComponents map(false, true);
  // The second run, whose lengths are metres, came into the first one's map 2.5 times too long.
  map.partition.move_component(1, 0, Sim3(SO3(), Eigen::Vector3d(-3, 2, 1), 2.5));
  const Eigen::Vector3d centre = map.S_map(0).translation();
  const Sim3 S_map_1 = map.S_map(1), S_map_3 = map.S_map(3);
  normalize_scales(map.chain, map.partition);
  EXPECT_LT((map.S_map(0).translation() - centre).norm(), kRounding);
  EXPECT_NEAR(map.S_map(3).scale(), 1, kRounding);
  EXPECT_NEAR(map.S_map(1).scale(), 0.4, kRounding);
  for (const auto& [id, before] : {std::pair(1, S_map_1), std::pair(3, S_map_3)})
    EXPECT_LT((map.S_map(id).translation() - centre - 0.4 * (before.translation() - centre)).norm(),
              kRounding);
}

TEST(PlaceComponents, TheFirstPlaceTellsTheScaleAloneIfItKnowsIt) {
  TwoComponents map(true, true);
  map.chain.add(KeyframeId(4), std::nullopt, false);  // the graph is over similarities
  map.partition.found(KeyframeId(4), Sim3(), 2, 3);
  map.partition.set_pose(PlaceId(1), Sim3(SO3(), Eigen::Vector3d(1, 0, 0), 1.2));
  normalize_scales(map.chain, map.partition);
  EXPECT_NEAR(map.S_map(0).scale(), 1, kRounding);
  EXPECT_NEAR(map.S_map(1).scale(), 1.2, kRounding);
}

TEST(PlaceComponents, NoPlaceHasAScaleWhereAllAreKnown) {
  TwoComponents map(true, true);
  const Eigen::Vector3d before = map.S_map(1).translation();
  map.partition.set_pose(PlaceId(1), Sim3(SO3(), before, 1.2));
  normalize_scales(map.chain, map.partition);
  EXPECT_EQ(map.S_map(1).scale(), 1);
  EXPECT_LT((map.S_map(1).translation() - before).norm(), kRounding);
}

}  // namespace place_components_test
}  // namespace placegraph
