#include <numbers>

#include <gtest/gtest.h>
#include <placegraph/pipeline/places/place_constraints.h>

#include "tests/support/place_links.h"

namespace placegraph {
namespace place_constraints_test {

using namespace test;

constexpr double kRounding = 1e-9;

Matrix7d diagonal(double translation, double rotation, double log_scale) {
  Matrix7d result = Matrix7d::Zero();
  result.diagonal() << translation, translation, translation, rotation, rotation, rotation,
      log_scale;
  return result;
}

/// Straight on along z: anchors 0 and 2 with a member each, 1 m and 5 m apart; 4 hangs on 3 in
/// another run, with a member 5.
struct Line {
  KeyframeChain chain;
  PlacePartition partition;

  explicit Line(bool second_known = true) {
    const SE3 near = pose({0, 0, 0}, {0, 0, 1}), far = pose({0, 0, 0}, {0, 0, 5});
    add(0, std::nullopt, true);
    add(1, link(0, near, 0.1, 0.02), false);
    add(2, link(1, far, 0.3, 0.01), true);
    add(3, link(2, near, 0.1, 0.02), false);
    KeyframeLink other = link(3, far, 0.2, 0.03);
    other.source = ConstraintSource::kOther;
    other.scale = second_known ? 1 : 2;
    add(4, other, true, second_known);
    add(5, link(4, near, 0.1, 0.02), false);
  }
  void add(std::int64_t id, const std::optional<KeyframeLink>& to_last, bool anchor,
           bool scale_known = true) {
    chain.add(KeyframeId(id), to_last, scale_known);
    if (anchor)
      partition.found(KeyframeId(id), Sim3(), 0, 3);
    else
      partition.join(KeyframeId(id), partition.segment_of(to_last->from));
  }
};

TEST(PlaceConstraints, CovariancesOfLinksAddUpFromAnchorToAnchor) {
  const Line line;
  const auto edges = link_edges(line.chain, line.partition, KeyframeId(0));
  ASSERT_EQ(edges.size(), 2u);
  EXPECT_EQ(edges[0].from_segment, KeyframeId(0));
  EXPECT_EQ(edges[0].to_segment, KeyframeId(2));
  EXPECT_LT(difference(edges[0].S_from_to, Sim3(pose({0, 0, 0}, {0, 0, 6}))), kRounding);
  // C = Ad C1 Ad^T + C2: the rotation of the first link moves the end of the second one, 5 m on,
  // sideways.
  Matrix7d expected = diagonal(0.01 + 0.09, 0.0004 + 0.0001, 0);
  expected(0, 0) += 25 * 0.0004;
  expected(1, 1) += 25 * 0.0004;
  expected(0, 4) = expected(4, 0) = 5 * 0.0004;
  expected(1, 3) = expected(3, 1) = -5 * 0.0004;
  EXPECT_LT((edges[0].covariance - expected).norm(), kRounding);
}

TEST(PlaceConstraints, AChainBeginsWithoutCovarianceAtEveryAnchor) {
  Line line;
  line.add(6, link(5, pose({0, 0, 0}, {0, 0, 5}), 0.3, 0.01), true);
  line.add(7, link(6, pose({0, 0, 0}, {0, 0, 5}), 0.3, 0.01), true);
  const auto edges = link_edges(line.chain, line.partition, KeyframeId(0));
  ASSERT_EQ(edges.size(), 4u);
  EXPECT_LT((edges[2].covariance - edges[0].covariance).norm(), kRounding);  // after another run
  EXPECT_LT((edges[3].covariance - diagonal(0.09, 0.0001, 0)).norm(), kRounding);
}

TEST(PlaceConstraints, ARunHangsOnTheAnchorOfTheKeyframeThatItsLinkNames) {
  const Line line(false);
  const PlaceEdge edge = link_edges(line.chain, line.partition, KeyframeId(0)).at(1);
  EXPECT_EQ(edge.from_segment, KeyframeId(2));
  EXPECT_EQ(edge.to_segment, KeyframeId(4));
  EXPECT_EQ(edge.source, ConstraintSource::kOther);
  EXPECT_LT(difference(edge.S_from_to, Sim3(SO3(), Eigen::Vector3d(0, 0, 6), 2)), kRounding);
  EXPECT_LT((edge.covariance - diagonal(0.04, 0.0009, 0)).norm(), kRounding);
}

TEST(PlaceConstraints, WhatIsKnownOfTheWholeMotionReplacesTheChain) {
  Line line;
  Matrix6d covariance = 0.01 * Matrix6d::Identity();
  covariance(0, 4) = covariance(4, 0) = 0.002;
  line.partition.set_motion_covariance(KeyframeId(2), covariance);
  line.chain.inform_link(KeyframeId(1), information_of(0.1, 0.02), 0.3);
  const PlaceEdge edge = link_edges(line.chain, line.partition, KeyframeId(0)).at(0);
  EXPECT_LT((edge.covariance.topLeftCorner<6, 6>() - covariance).norm(), kRounding);
  EXPECT_NEAR(edge.covariance(6, 6), 0.09, kRounding);  // the scale's is that of the links
  EXPECT_LT((edge.covariance.topRightCorner<6, 1>()).norm(), kRounding);
}

TEST(PlaceConstraints, EdgesSinceAKeyframeAreThoseOfItAndLaterOnes) {
  const Line line;
  const auto all = link_edges(line.chain, line.partition, KeyframeId(0));
  const auto keys_since = [&](std::int64_t since) {
    std::vector<std::int64_t> keys;
    for (const PlaceEdge& edge : link_edges(line.chain, line.partition, KeyframeId(since))) {
      keys.push_back(edge.key.second);
      for (const PlaceEdge& other : all)
        if (other.key == edge.key) {
          EXPECT_EQ(edge.covariance, other.covariance) << since;
        }
    }
    return keys;
  };
  EXPECT_EQ(keys_since(1), (std::vector<std::int64_t>{2, 4}));
  EXPECT_EQ(keys_since(2), (std::vector<std::int64_t>{2, 4}));
  EXPECT_EQ(keys_since(3), (std::vector<std::int64_t>{4}));
  EXPECT_TRUE(keys_since(5).empty());
  EXPECT_TRUE(keys_since(9).empty());
}

TEST(PlaceConstraints, ALoopIsCarriedToTheAnchorsOfItsKeyframes) {
  const Line line;
  const SE3 T_1_5 = pose({0, 0.4, 0}, {1, 0, 2});
  const PlaceEdge edge = loop_edge(line.chain, line.partition, loop(5, 1, T_1_5, 0.1, 0.01), 7);
  EXPECT_EQ(edge.key.second, 7);
  EXPECT_EQ(edge.from_segment, KeyframeId(0));
  EXPECT_EQ(edge.to_segment, KeyframeId(4));
  const SE3 near = pose({0, 0, 0}, {0, 0, 1});
  EXPECT_LT(difference(edge.S_from_to, Sim3(near * T_1_5 * near.inverse())), kRounding);
  // The anchor is 1 m behind the query: its rotation moves the anchor sideways.
  EXPECT_NEAR(edge.covariance(0, 0), 0.01 + 0.0001, kRounding);
  EXPECT_NEAR(edge.covariance(2, 2), 0.01 + 1e-6, kRounding);  // and its scale along the way
  EXPECT_NEAR(edge.covariance(3, 3), 0.0001, kRounding);
  EXPECT_NEAR(edge.covariance(0, 4), -0.0001, kRounding);
}

TEST(PlaceConstraints, ALoopTellsTheScaleWhereItIsNotKnown) {
  const Loop seen = scaled_loop(4, 0, SE3(), 2);
  const Line unknown(false), known(true);
  EXPECT_NEAR(loop_edge(unknown.chain, unknown.partition, seen, 0).covariance(6, 6), 1e-4,
              kRounding);
  EXPECT_NEAR(loop_edge(known.chain, known.partition, seen, 0).covariance(6, 6), 1e-6, kRounding);
}

TEST(PlaceConstraints, MetresOfOtherSensorsSayNothingOfAnUnknownScale) {
  const PlaceHistory::Motion motion{KeyframeId(2), KeyframeId(4), pose({0, 0, 0}, {0, 0, 6}),
                                    0.01 * Matrix6d::Identity()};
  EXPECT_FALSE(motion_edge(Line(false).chain, motion, 0));
  const auto edge = motion_edge(Line(true).chain, motion, 3);
  ASSERT_TRUE(edge);
  EXPECT_EQ(edge->from_segment, KeyframeId(2));
  EXPECT_EQ(edge->to_segment, KeyframeId(4));
  EXPECT_EQ(edge->key, PlaceConstraint::Key(PlaceConstraint::Kind::kMotion, 3));
  EXPECT_LT((edge->covariance - diagonal(0.01, 0.01, 1e-6)).norm(), kRounding);
}

TEST(PlaceConstraints, BetweenPlacesTheCovariancesOfTheirPartsAreAdded) {
  // Part 4 stands in place 1 turned by a right angle about y, 2 m to its right.
  Line line;
  const Sim3 S_1_4(pose({0, std::numbers::pi / 2, 0}, {2, 0, 0}));
  line.partition.set_pose(PlaceId(2), S_1_4);
  Matrix7d of_segment = Matrix7d::Zero();
  of_segment(2, 2) = 0.5;  // along the part's z, which is the place's x
  line.partition.merge(PlaceId(1), PlaceId(2),
                       of_segment);  // the place of part 4 is the younger one: in its frame
  ASSERT_LT((line.partition.segments().at(KeyframeId(4)).covariance - of_segment).norm(),
            kRounding);
  PlaceEdge edge;
  edge.from_segment = KeyframeId(0);
  edge.to_segment = KeyframeId(4);
  edge.S_from_to = Sim3(pose({0, 0, 0}, {0, 0, 6}));
  edge.covariance = diagonal(0.01, 0.0001, 0);
  const auto constraint = constraint_between_places(line.partition, edge, true);
  EXPECT_EQ(constraint.from, NodeId(0));
  EXPECT_EQ(constraint.to, NodeId(1));
  const SE3 T = std::get<SE3>(constraint.T_from_to);
  EXPECT_LT(distance_m(T, rigid_part(edge.S_from_to * S_1_4.inverse())), kRounding);
  const Matrix6d covariance = Matrix6d(constraint.information).inverse();
  EXPECT_NEAR(covariance(0, 0), 0.51, 1e-6);
  EXPECT_NEAR(covariance(1, 1), 0.01 + 4 * 0.0001, 1e-6);
  EXPECT_NEAR(covariance(2, 2), 0.01 + 4 * 0.0001, 1e-6);
  // Over similarities, no scale is held better than its least variance.
  const auto scaled = constraint_between_places(line.partition, edge, false);
  EXPECT_LT(difference(std::get<Sim3>(scaled.T_from_to), Sim3(T)), kRounding);
  EXPECT_NEAR(Matrix7d(scaled.information)(6, 6) * 1e-6, 1, 0.01);
}

TEST(PlaceConstraints, TheCovarianceOfTheFirstPartIsSeenFromTheSecond) {
  Line line;
  Matrix7d of_segment = Matrix7d::Zero();
  of_segment(4, 4) = 0.01;  // rotation of part 2 in place 0 about y
  line.partition.merge(PlaceId(0), PlaceId(1), of_segment);
  PlaceEdge edge;
  edge.from_segment = KeyframeId(2);
  edge.to_segment = KeyframeId(4);
  edge.S_from_to = Sim3(pose({0, 0, 0}, {0, 0, 6}));
  edge.covariance = diagonal(0.01, 0.0001, 0);
  const Matrix6d covariance =
      Matrix6d(constraint_between_places(line.partition, edge, true).information).inverse();
  EXPECT_NEAR(covariance(0, 0), 0.01 + 36 * 0.01, 1e-6);
  EXPECT_NEAR(covariance(2, 2), 0.01, 1e-6);
}

TEST(PlaceConstraints, EveryKindHasItsKernelAndNoneMeasuresWithinAPlace) {
  const Line line;
  PlaceOptions options;
  options.loop_kernel = {RobustKernel::Kind::kTukey, 4};
  options.motion_kernel = {RobustKernel::Kind::kHuber, 5};
  const std::vector<Loop> loops{loop(5, 1, SE3(), 0.1, 0.01), loop(1, 0, SE3(), 0.1, 0.01)};
  const std::vector<PlaceHistory::Motion> motions{
      {KeyframeId(2), KeyframeId(4), SE3(), Matrix6d::Identity()}};
  const auto constraints =
      place_constraints(line.chain, line.partition, loops, motions, options, KeyframeId(0));
  ASSERT_EQ(constraints.size(), 5u);
  const std::vector<RobustKernel::Kind> kinds{RobustKernel::Kind::kNone, RobustKernel::Kind::kTukey,
                                              RobustKernel::Kind::kTukey};
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    ASSERT_TRUE(constraints[i].measured) << i;
    EXPECT_EQ(constraints[i].measured->kernel.kind, kinds[i]) << i;
  }
  EXPECT_FALSE(constraints[3].measured);  // the loop between two keyframes of one place
  EXPECT_EQ(constraints[4].measured->kernel.width, 5);
  const auto since =
      place_constraints(line.chain, line.partition, loops, motions, options, KeyframeId(5));
  ASSERT_EQ(since.size(), 1u);
  EXPECT_EQ(since[0].key, constraints[2].key);
}

}  // namespace place_constraints_test
}  // namespace placegraph
