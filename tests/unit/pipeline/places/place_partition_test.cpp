#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/places/place_partition.h>

#include "tests/unit/pipeline/places/row_of_places.h"

namespace placegraph {
namespace place_partition_test {

using namespace test;

TEST(PlacePartition, AKeyframeStandsWhereItsPartHasIt) {
  const Row row;
  EXPECT_EQ(row.partition.place_of(KeyframeId(3)), PlaceId(1));
  EXPECT_EQ(row.partition.segment_of(KeyframeId(3)), KeyframeId(2));
  EXPECT_EQ(row.partition.state_of(KeyframeId(3)).last_keyframe, KeyframeId(3));
  EXPECT_TRUE(row.partition.is_anchor(KeyframeId(2)));
  EXPECT_FALSE(row.partition.is_anchor(KeyframeId(3)));
  EXPECT_LT(difference(row.S_map(3), row.S_map(2) * Sim3(kShort)), kRounding);
  EXPECT_EQ(row.partition.previous_anchor(row.chain, KeyframeId(4)), KeyframeId(2));
  EXPECT_FALSE(row.partition.previous_anchor(row.chain, KeyframeId(3)));  // a member
  EXPECT_FALSE(row.partition.previous_anchor(row.chain, KeyframeId(0)));  // the first
}

TEST(PlacePartition, AMergerMovesNoKeyframe) {
  Row row;
  std::vector<Sim3> before;
  for (int id = 0; id <= 4; ++id) before.push_back(row.S_map(id));
  Matrix7d covariance = Matrix7d::Identity();
  covariance.diagonal() << 1, 2, 3, 0, 0, 0, 0;
  EXPECT_EQ(row.partition.merge(PlaceId(0), PlaceId(1), covariance), KeyframeId(2));
  for (int id = 0; id <= 4; ++id) EXPECT_LT(difference(row.S_map(id), before[id]), kRounding) << id;
  EXPECT_EQ(row.partition.places().size(), 2u);
  EXPECT_EQ(row.partition.place_of(KeyframeId(3)), PlaceId(0));
  EXPECT_EQ(row.partition.state_of(KeyframeId(0)).last_keyframe, KeyframeId(3));
  EXPECT_LT((row.partition.segments().at(KeyframeId(2)).covariance - covariance).norm(), kRounding);
  const auto listed = row.partition.graph_places(row.chain);
  ASSERT_EQ(listed.size(), 2u);
  ASSERT_EQ(listed[0].members.size(), 4u);
  EXPECT_LT(
      difference(listed[0].S_map_place() * listed[0].members[3].S_place_keyframe(), before[3]),
      kRounding);
  EXPECT_THROW(row.partition.merge(PlaceId(0), PlaceId(0), covariance), ArgumentError);
}

TEST(PlacePartition, ASecondMergerAddsItsCovarianceInTheFrameOfThePart) {
  Row row;
  Matrix7d first = Matrix7d::Zero();
  first(2, 2) = 0.5;
  row.partition.merge(PlaceId(1), PlaceId(2), first);
  const Sim3 S_place_segment = row.partition.segments().at(KeyframeId(4)).S_place_segment;
  Matrix7d covariance = Matrix7d::Zero();
  covariance(1, 1) = 1;  // about the y axis alone: a lateral shift
  covariance(4, 4) = 0.01;
  row.partition.merge(PlaceId(0), PlaceId(1), covariance);
  // A rotation w of the place about y moves the part, 5 m ahead, sideways by w times 5 m.
  const double ahead = S_place_segment.translation().z();
  const SO3 R = S_place_segment.rotation();
  const Eigen::Vector3d side =
      R.inverse() * Eigen::Vector3d(ahead, 0, -S_place_segment.translation().x());
  Eigen::Matrix3d expected = 0.01 * side * side.transpose();
  expected(1, 1) += 1;
  expected(2, 2) += 0.5;
  const Matrix7d& found = row.partition.segments().at(KeyframeId(4)).covariance;
  EXPECT_LT((found.topLeftCorner<3, 3>() - expected).norm(), kRounding);
}

TEST(PlacePartition, SeparatingUndoesAMergerWhereThePlacesStandNow) {
  Row row;
  const Matrix7d covariance = 0.1 * Matrix7d::Identity();
  row.partition.merge(PlaceId(0), PlaceId(1), covariance);
  const Sim3 S_new_old(pose({0, 1, 0}, {7, 0, 0}));
  row.partition.set_pose(PlaceId(0), S_new_old * row.partition.state_of(KeyframeId(0)).S_map_place);
  const Sim3 S_map_0 = row.S_map(0), S_map_3 = row.S_map(3);
  EXPECT_EQ(row.partition.separate(0), KeyframeId(2));
  EXPECT_TRUE(row.partition.merged().empty());
  EXPECT_EQ(row.partition.place_of(KeyframeId(2)), PlaceId(3));  // number 1 is not given again
  EXPECT_EQ(row.partition.place_of(KeyframeId(3)), PlaceId(3));
  EXPECT_EQ(row.partition.place_of(KeyframeId(1)), PlaceId(0));
  const auto& place = row.partition.state_of(KeyframeId(2));
  EXPECT_EQ(place.anchor_keyframe, KeyframeId(2));
  EXPECT_EQ(place.last_keyframe, KeyframeId(3));
  EXPECT_LT(difference(row.S_map(0), S_map_0), kRounding);
  EXPECT_LT(difference(row.S_map(3), S_map_3), kRounding);
  EXPECT_LT(difference(place.S_map_place, row.S_map(2)), kRounding);
  EXPECT_LT(difference(row.partition.segments().at(KeyframeId(2)).S_place_segment, Sim3()),
            kRounding);
  EXPECT_EQ(row.partition.segments().at(KeyframeId(2)).covariance.norm(), 0);
  EXPECT_TRUE(row.partition.were_separated(PlaceId(0), PlaceId(3)));
  EXPECT_TRUE(row.partition.were_separated(PlaceId(3), PlaceId(0)));
  EXPECT_FALSE(row.partition.were_separated(PlaceId(0), PlaceId(2)));
}

TEST(PlacePartition, AComponentOfOneRunGrowsAboutItsFirstKeyframe) {
  Row row(false);
  row.partition.merge(PlaceId(0), PlaceId(1), 0.1 * Matrix7d::Identity());
  const Sim3 S_map_0 = row.S_map(0), S_map_3 = row.S_map(3), S_map_4 = row.S_map(4);
  row.partition.rescale(row.chain, KeyframeId(0), 2);
  row.chain.rescale(KeyframeId(0), 2);
  const Eigen::Vector3d centre = S_map_0.translation();
  EXPECT_LT(difference(row.S_map(0), S_map_0), kRounding);
  for (const auto& [id, before] : {std::pair(3, S_map_3), std::pair(4, S_map_4)}) {
    EXPECT_LT((row.S_map(id).translation() - centre - 2 * (before.translation() - centre)).norm(),
              kRounding);
    EXPECT_NEAR(row.S_map(id).scale(), 1, kRounding);
  }
  EXPECT_NEAR(row.partition.state_of(KeyframeId(0)).reach, 6, kRounding);
  EXPECT_NEAR(row.partition.segments().at(KeyframeId(2)).covariance(0, 0), 0.4, kRounding);
  EXPECT_NEAR(row.partition.segments().at(KeyframeId(2)).covariance(4, 4), 0.1, kRounding);
}

TEST(PlacePartition, ARunInACompanyOfOthersStaysWhereItIsAndShrinksItsScale) {
  Row row;
  KeyframeLink other = link(4, kLong);
  other.source = ConstraintSource::kOther;
  row.chain.add(KeyframeId(5), other, false);
  row.partition.found(KeyframeId(5), row.S_map(4) * Sim3(kLong), 0, 3);
  row.chain.add(KeyframeId(6), link(5, kShort));
  row.partition.join(KeyframeId(6), KeyframeId(5));
  const Sim3 S_map_4 = row.S_map(4), S_map_6 = row.S_map(6);
  row.partition.rescale(row.chain, KeyframeId(5), 2);
  row.chain.rescale(KeyframeId(5), 2);
  EXPECT_LT(difference(row.S_map(4), S_map_4), kRounding);
  EXPECT_LT((row.S_map(6).translation() - S_map_6.translation()).norm(), kRounding);
  EXPECT_NEAR(row.S_map(6).scale(), 0.5, kRounding);
  EXPECT_NEAR(row.partition.state_of(KeyframeId(4)).reach, 3, kRounding);
}

TEST(PlacePartition, ASavedPartitionIsTheSameWhenItIsRestored) {
  Row row;
  row.partition.merge(PlaceId(0), PlaceId(1), 0.1 * Matrix7d::Identity());
  row.partition.separate(0);
  row.partition.merge(PlaceId(0), PlaceId(2), 0.1 * Matrix7d::Identity());
  row.partition.set_motion_covariance(KeyframeId(2), Matrix6d::Identity());
  PlaceHistory history;
  row.partition.save(history);
  for (const auto& [id, keyframe] : row.chain.keyframes())
    history.keyframes.push_back(
        {id, row.partition.segment_of(KeyframeId(id)), keyframe.track_segment, keyframe.link});
  const PlacePartition restored(row.partition.graph_places(row.chain), history);
  for (int id = 0; id <= 4; ++id) {
    EXPECT_EQ(restored.place_of(KeyframeId(id)), row.partition.place_of(KeyframeId(id))) << id;
    EXPECT_LT(difference(restored.S_map_keyframe(row.chain, KeyframeId(id)), row.S_map(id)),
              kRounding)
        << id;
  }
  EXPECT_EQ(restored.state_of(KeyframeId(2)).last_keyframe, KeyframeId(3));
  EXPECT_EQ(restored.state_of(KeyframeId(2)).reach, row.partition.state_of(KeyframeId(2)).reach);
  EXPECT_EQ(restored.merged().size(), 1u);
  EXPECT_TRUE(restored.were_separated(PlaceId(0), PlaceId(3)));
  EXPECT_TRUE(restored.segments().at(KeyframeId(2)).motion_covariance);
  history.founded = 0;
  EXPECT_THROW(PlacePartition(row.partition.graph_places(row.chain), history), ArgumentError);
}

}  // namespace place_partition_test
}  // namespace placegraph
