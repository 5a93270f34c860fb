#include <numbers>

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/places/place_partition.h>

#include "tests/support/place_links.h"

namespace placegraph {
namespace {

using namespace test;

constexpr double kRounding = 1e-9;

double difference(const Sim3& a, const Sim3& b) { return (a.matrix() - b.matrix()).norm(); }

/// Keyframes 0 (with 1), 2 (with 3) and 4, each an anchor 5 m after the last, in one component.
struct Row {
  KeyframeChain chain;
  PlacePartition partition;

  explicit Row(bool scale_known = true) {
    const SE3 T_map_0 = pose({0, 0.3, 0}, {1, 2, 3});
    chain.add(0, std::nullopt, scale_known);
    partition.found(0, Sim3(T_map_0), 0, 3);
    chain.add(1, link(0, kShort));
    partition.join(1, 0);
    chain.add(2, link(1, kLong));
    partition.found(2, Sim3(T_map_0 * kShort * kLong), 0, 3);
    chain.add(3, link(2, kShort));
    partition.join(3, 2);
    chain.add(4, link(3, kLong));
    partition.found(4, Sim3(T_map_0 * kShort * kLong * kShort * kLong), 0, 3);
  }
  Sim3 S_map(std::int64_t keyframe) const { return partition.S_map_keyframe(chain, keyframe); }
};

TEST(PlacePartition, AKeyframeStandsWhereItsPartHasIt) {
  const Row row;
  EXPECT_EQ(row.partition.place_of(3), 1);
  EXPECT_EQ(row.partition.part_of(3), 2);
  EXPECT_EQ(row.partition.state_of(3).last_keyframe, 3);
  EXPECT_TRUE(row.partition.is_anchor(2));
  EXPECT_FALSE(row.partition.is_anchor(3));
  EXPECT_LT(difference(row.S_map(3), row.S_map(2) * Sim3(kShort)), kRounding);
  EXPECT_EQ(row.partition.previous_anchor(row.chain, 4), 2);
  EXPECT_FALSE(row.partition.previous_anchor(row.chain, 3));  // a member
  EXPECT_FALSE(row.partition.previous_anchor(row.chain, 0));  // the first
}

TEST(PlacePartition, AMergerMovesNoKeyframe) {
  Row row;
  std::vector<Sim3> before;
  for (int id = 0; id <= 4; ++id) before.push_back(row.S_map(id));
  Matrix7d covariance = Matrix7d::Identity();
  covariance.diagonal() << 1, 2, 3, 0, 0, 0, 0;
  EXPECT_EQ(row.partition.merge(0, 1, covariance), 2);
  for (int id = 0; id <= 4; ++id) EXPECT_LT(difference(row.S_map(id), before[id]), kRounding) << id;
  EXPECT_EQ(row.partition.places().size(), 2u);
  EXPECT_EQ(row.partition.place_of(3), 0);
  EXPECT_EQ(row.partition.state_of(0).last_keyframe, 3);
  EXPECT_LT((row.partition.parts().at(2).covariance - covariance).norm(), kRounding);
  const auto listed = row.partition.graph_places(row.chain);
  ASSERT_EQ(listed.size(), 2u);
  ASSERT_EQ(listed[0].members.size(), 4u);
  EXPECT_LT(
      difference(listed[0].S_map_place() * listed[0].members[3].S_place_keyframe(), before[3]),
      kRounding);
  EXPECT_THROW(row.partition.merge(0, 0, covariance), ArgumentError);
}

TEST(PlacePartition, ASecondMergerAddsItsCovarianceInTheFrameOfThePart) {
  Row row;
  Matrix7d first = Matrix7d::Zero();
  first(2, 2) = 0.5;
  row.partition.merge(1, 2, first);
  const Sim3 S_place_part = row.partition.parts().at(4).S_place_part;
  Matrix7d covariance = Matrix7d::Zero();
  covariance(1, 1) = 1;  // about the y axis alone: a lateral shift
  covariance(4, 4) = 0.01;
  row.partition.merge(0, 1, covariance);
  // A rotation w of the place about y moves the part, 5 m ahead, sideways by w times 5 m.
  const double ahead = S_place_part.translation().z();
  const SO3 R = S_place_part.rotation();
  const Eigen::Vector3d side =
      R.inverse() * Eigen::Vector3d(ahead, 0, -S_place_part.translation().x());
  Eigen::Matrix3d expected = 0.01 * side * side.transpose();
  expected(1, 1) += 1;
  expected(2, 2) += 0.5;
  const Matrix7d& found = row.partition.parts().at(4).covariance;
  EXPECT_LT((found.topLeftCorner<3, 3>() - expected).norm(), kRounding);
}

TEST(PlacePartition, SeparatingUndoesAMergerWhereThePlacesStandNow) {
  Row row;
  const Matrix7d covariance = 0.1 * Matrix7d::Identity();
  row.partition.merge(0, 1, covariance);
  const Sim3 S_new_old(pose({0, 1, 0}, {7, 0, 0}));
  row.partition.set_pose(0, S_new_old * row.partition.state_of(0).S_map_place);
  const Sim3 S_map_0 = row.S_map(0), S_map_3 = row.S_map(3);
  EXPECT_EQ(row.partition.separate(0), 2);
  EXPECT_TRUE(row.partition.merged().empty());
  EXPECT_EQ(row.partition.place_of(2), 3);  // number 1 is not given again
  EXPECT_EQ(row.partition.place_of(3), 3);
  EXPECT_EQ(row.partition.place_of(1), 0);
  const auto& place = row.partition.state_of(2);
  EXPECT_EQ(place.anchor_keyframe, 2);
  EXPECT_EQ(place.last_keyframe, 3);
  EXPECT_LT(difference(row.S_map(0), S_map_0), kRounding);
  EXPECT_LT(difference(row.S_map(3), S_map_3), kRounding);
  EXPECT_LT(difference(place.S_map_place, row.S_map(2)), kRounding);
  EXPECT_LT(difference(row.partition.parts().at(2).S_place_part, Sim3()), kRounding);
  EXPECT_EQ(row.partition.parts().at(2).covariance.norm(), 0);
  EXPECT_TRUE(row.partition.have_parted(0, 3));
  EXPECT_TRUE(row.partition.have_parted(3, 0));
  EXPECT_FALSE(row.partition.have_parted(0, 2));
}

TEST(PlacePartition, AComponentOfOneRunGrowsAboutItsFirstKeyframe) {
  Row row(false);
  row.partition.merge(0, 1, 0.1 * Matrix7d::Identity());
  const Sim3 S_map_0 = row.S_map(0), S_map_3 = row.S_map(3), S_map_4 = row.S_map(4);
  row.partition.rescale(row.chain, 0, 2);
  row.chain.rescale(0, 2);
  const Eigen::Vector3d centre = S_map_0.translation();
  EXPECT_LT(difference(row.S_map(0), S_map_0), kRounding);
  for (const auto& [id, before] : {std::pair(3, S_map_3), std::pair(4, S_map_4)}) {
    EXPECT_LT((row.S_map(id).translation() - centre - 2 * (before.translation() - centre)).norm(),
              kRounding);
    EXPECT_NEAR(row.S_map(id).scale(), 1, kRounding);
  }
  EXPECT_NEAR(row.partition.state_of(0).reach, 6, kRounding);
  EXPECT_NEAR(row.partition.parts().at(2).covariance(0, 0), 0.4, kRounding);
  EXPECT_NEAR(row.partition.parts().at(2).covariance(4, 4), 0.1, kRounding);
}

TEST(PlacePartition, ARunInACompanyOfOthersStaysWhereItIsAndShrinksItsScale) {
  Row row;
  KeyframeLink other = link(4, kLong);
  other.source = ConstraintSource::kOther;
  row.chain.add(5, other, false);
  row.partition.found(5, row.S_map(4) * Sim3(kLong), 0, 3);
  row.chain.add(6, link(5, kShort));
  row.partition.join(6, 5);
  const Sim3 S_map_4 = row.S_map(4), S_map_6 = row.S_map(6);
  row.partition.rescale(row.chain, 5, 2);
  row.chain.rescale(5, 2);
  EXPECT_LT(difference(row.S_map(4), S_map_4), kRounding);
  EXPECT_LT((row.S_map(6).translation() - S_map_6.translation()).norm(), kRounding);
  EXPECT_NEAR(row.S_map(6).scale(), 0.5, kRounding);
  EXPECT_NEAR(row.partition.state_of(4).reach, 3, kRounding);
}

TEST(PlacePartition, TheEarlierPlaceIsTheNearestInReachThatLooksTheSameWay) {
  // 0 .. 3 once around a square of 5 m sides; 4 is back at 0 with an error of 1 m.
  KeyframeChain chain;
  PlacePartition partition;
  const SE3 side = pose({0, std::numbers::pi / 2, 0}, {0, 0, 5});
  SE3 T_map_this = pose({0.1, 0, 0}, {1, 1, 1});
  for (int i = 0; i < 5; ++i, T_map_this = T_map_this * side) {
    chain.add(i, i == 0 ? std::nullopt : std::optional(link(i - 1, side)));
    partition.found(i, Sim3(T_map_this * pose({0, 0, 0}, {i == 4 ? 1.0 : 0, 0, 0})), 0, 3);
  }
  const Sim3 S_map_here = partition.state_of(4).S_map_place;
  const auto earlier = [&](const Sim3& S, double reach) {
    return earlier_place_in_reach(chain, partition, {}, 4, S, reach);
  };
  EXPECT_EQ(earlier(S_map_here, 3), 0);
  EXPECT_FALSE(earlier(S_map_here, 0.9));
  EXPECT_FALSE(earlier(S_map_here * Sim3(pose({0, 0.4, 0}, {0, 0, 0})), 3));  // 23 deg
  EXPECT_EQ(earlier(S_map_here * Sim3(pose({0, 0.3, 0}, {0, 0, 0})), 3), 0);  // 17 deg
  // A path of 20 m that leads no further than twice the reach is no way round.
  EXPECT_FALSE(earlier(S_map_here, 10.1));
  // No place is earlier than the first.
  EXPECT_FALSE(
      earlier_place_in_reach(chain, partition, {}, 0, partition.state_of(0).S_map_place, 3));
}

TEST(PlacePartition, OfTwoEarlierPlacesInReachTheNearerOneCounts) {
  KeyframeChain chain;
  PlacePartition partition;
  const double x[] = {0, 1, 0.2};
  for (int i = 0; i < 3; ++i) {  // three runs of tracking, so that no short path joins them
    chain.add(i, std::nullopt);
    partition.found(i, Sim3(SO3(), Eigen::Vector3d(x[i], 0, 0), 1), 0, 3);
  }
  EXPECT_EQ(earlier_place_in_reach(chain, partition, {}, 2, partition.state_of(2).S_map_place, 3),
            0);
}

TEST(PlacePartition, AKeyframeWithinReachOfTheAnchorBelongsToItsPart) {
  Row row;
  const auto in_reach = [&](const SE3& T_4_this, double median_depth) {
    Row other = row;
    other.chain.add(5, link(4, T_4_this));
    return in_reach_of_part(other.chain, other.partition, {}, {}, 5, median_depth);
  };
  EXPECT_TRUE(in_reach(pose({0, 0, 0}, {0, 0, 2.9}), 10));
  EXPECT_FALSE(in_reach(pose({0, 0, 0}, {0, 0, 3.1}), 10));
  EXPECT_FALSE(in_reach(pose({0, 0, 0}, {0, 0, 2.9}), 9));
  EXPECT_TRUE(in_reach(pose({0, 0.34, 0}, {0, 0, 1}), 10));   // 19.5 deg
  EXPECT_FALSE(in_reach(pose({0, 0.36, 0}, {0, 0, 1}), 10));  // 20.6 deg
}

/// Two runs, each its own component: 0 and 1, 5 m apart; 2 and 3, too.
struct TwoComponents {
  KeyframeChain chain;
  PlacePartition partition;

  TwoComponents(bool first_known, bool second_known) {
    chain.add(0, std::nullopt, first_known);
    partition.found(0, Sim3(), 0, 3);
    chain.add(1, link(0, kLong));
    partition.found(1, Sim3(kLong), 0, 3);
    const SE3 T_map_2 = pose({0, 1, 0}, {50, 0, 0});
    chain.add(2, std::nullopt, second_known);
    partition.found(2, Sim3(T_map_2), 1, 3);
    chain.add(3, link(2, kLong));
    partition.found(3, Sim3(T_map_2 * kLong), 1, 3);
  }
  Sim3 S_map(std::int64_t keyframe) const { return partition.S_map_keyframe(chain, keyframe); }
};

TEST(PlacePartition, ALoopMovesTheYoungerComponentAsAWholeToWhereItSays) {
  for (const bool query_is_younger : {true, false}) {
    TwoComponents map(true, false);
    const Sim3 S_1_3(pose({0, -0.1, 0}, {1, 0, 2}).rotation(), {1, 0, 2}, 2.5);
    const Sim3 S_3_1 = S_1_3.inverse();
    Loop loop = query_is_younger ? scaled_loop(3, 1, rigid_part(S_1_3), 2.5)
                                 : scaled_loop(1, 3, rigid_part(S_3_1), 1 / 2.5);
    const Sim3 S_2_3 = map.S_map(2).inverse() * map.S_map(3);
    join_components(map.chain, {loop}, map.partition);
    EXPECT_EQ(map.partition.state_of(3).component, 0);
    EXPECT_EQ(map.partition.state_of(2).component, 0);
    EXPECT_LT(difference(map.S_map(1), Sim3(kLong)), kRounding);
    EXPECT_LT(difference(map.S_map(3), Sim3(kLong) * S_1_3), kRounding);
    EXPECT_LT(difference(map.S_map(2).inverse() * map.S_map(3), S_2_3), kRounding);
  }
}

TEST(PlacePartition, AComponentTakesTheScaleThatOneOfItsPlacesKnows) {
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

TEST(PlacePartition, TheFirstPlaceTellsTheScaleAloneIfItKnowsIt) {
  TwoComponents map(true, true);
  map.chain.add(4, std::nullopt, false);  // the graph is over similarities
  map.partition.found(4, Sim3(), 2, 3);
  map.partition.set_pose(1, Sim3(SO3(), Eigen::Vector3d(1, 0, 0), 1.2));
  normalize_scales(map.chain, map.partition);
  EXPECT_NEAR(map.S_map(0).scale(), 1, kRounding);
  EXPECT_NEAR(map.S_map(1).scale(), 1.2, kRounding);
}

TEST(PlacePartition, NoPlaceHasAScaleWhereAllAreKnown) {
  TwoComponents map(true, true);
  const Eigen::Vector3d before = map.S_map(1).translation();
  map.partition.set_pose(1, Sim3(SO3(), before, 1.2));
  normalize_scales(map.chain, map.partition);
  EXPECT_EQ(map.S_map(1).scale(), 1);
  EXPECT_LT((map.S_map(1).translation() - before).norm(), kRounding);
}

TEST(PlacePartition, ASavedPartitionIsTheSameWhenItIsRestored) {
  Row row;
  row.partition.merge(0, 1, 0.1 * Matrix7d::Identity());
  row.partition.separate(0);
  row.partition.merge(0, 2, 0.1 * Matrix7d::Identity());
  row.partition.set_motion_covariance(2, Matrix6d::Identity());
  PlaceHistory history;
  row.partition.save(history);
  for (const auto& [id, keyframe] : row.chain.keyframes())
    history.keyframes.push_back({id, row.partition.part_of(id), keyframe.run, keyframe.link});
  const PlacePartition restored(row.partition.graph_places(row.chain), history);
  for (int id = 0; id <= 4; ++id) {
    EXPECT_EQ(restored.place_of(id), row.partition.place_of(id)) << id;
    EXPECT_LT(difference(restored.S_map_keyframe(row.chain, id), row.S_map(id)), kRounding) << id;
  }
  EXPECT_EQ(restored.state_of(2).last_keyframe, 3);
  EXPECT_EQ(restored.state_of(2).reach, row.partition.state_of(2).reach);
  EXPECT_EQ(restored.merged().size(), 1u);
  EXPECT_TRUE(restored.have_parted(0, 3));
  EXPECT_TRUE(restored.parts().at(2).motion_covariance);
  history.founded = 0;
  EXPECT_THROW(PlacePartition(row.partition.graph_places(row.chain), history), ArgumentError);
}

}  // namespace
}  // namespace placegraph
