#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/places/place_mapper.h>

#include "tests/support/place_links.h"

namespace placegraph {
namespace place_mapper_test {

using namespace test;

TEST(PlaceMapper, GathersNearKeyframesInOnePlace) {
  PlaceMapper mapper({});
  const SE3 T_map_first = pose({0, 0.3, 0}, {1, 2, 3});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, T_map_first, kDepth_m);
  mapper.add_keyframe(KeyframeId(1), link(0, kShort), {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(2), link(1, kShort), {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(3), link(2, kLong), {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(4), link(3, pose({0, 0.5, 0}, {0, 0, 0.1})), {},
                      kDepth_m);  // turned by 29 deg
  const PlaceGraph graph = mapper.place_graph();
  ASSERT_EQ(graph.places.size(), 3u);
  ASSERT_EQ(graph.places[0].members.size(), 3u);
  EXPECT_EQ(graph.places[0].anchor_keyframe, KeyframeId(0));
  EXPECT_LT(distance_m(graph.places[0].members[0].T_place_keyframe, SE3()), 1e-12);
  EXPECT_LT(distance_m(graph.places[0].members[2].T_place_keyframe, kShort * kShort), 1e-12);
  EXPECT_EQ(mapper.place_of(KeyframeId(2)), PlaceId(0));
  EXPECT_EQ(mapper.place_of(KeyframeId(3)), PlaceId(1));
  EXPECT_EQ(mapper.place_of(KeyframeId(4)), PlaceId(2));
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(3)), T_map_first * kShort * kShort * kLong),
            1e-12);
  EXPECT_LT(distance_m(mapper.odometry(KeyframeId(1), KeyframeId(3))->T_a_b, kShort * kLong),
            1e-12);
  EXPECT_NEAR(mapper.odometry(KeyframeId(3), KeyframeId(1))->path_length,
              kShort.translation().norm() + kLong.translation().norm(), 1e-12);
  EXPECT_FALSE(mapper.odometry(KeyframeId(0), KeyframeId(9)));
  EXPECT_THROW(mapper.add_keyframe(KeyframeId(4), std::nullopt, {}, kDepth_m), ArgumentError);
}

TEST(PlaceMapper, CorrectedLinksMoveAllThatFollows) {
  PlaceMapper mapper({});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  for (int i = 1; i < 4; ++i) mapper.add_keyframe(KeyframeId(i), link(i - 1, kLong), {}, kDepth_m);
  Vector6d change;
  change << 0.1, 0, 0.2, 0, 0.05, 0;
  mapper.correct_links({{KeyframeId(1), change}, {KeyframeId(3), -change}});
  const SE3 expected = kLong * SE3::exp(change) * kLong * kLong * SE3::exp(-change);
  EXPECT_LT(
      (mapper.odometry(KeyframeId(0), KeyframeId(3))->T_a_b.inverse() * expected).log().norm(),
      1e-12);
  ASSERT_TRUE(mapper.finish().outcome);
  EXPECT_LT((mapper.T_map_keyframe(KeyframeId(3)).inverse() * expected).log().norm(), 1e-6);
  EXPECT_THROW(mapper.correct_links({{KeyframeId(0), change}}), ArgumentError);
}

TEST(PlaceMapper, AddsUpTheCovariancesOfTheLinksBetweenAnchors) {
  // 0 -> 1 (a member) -> 2 (a new place), straight on, so that the sum can be written by hand:
  // C = Ad C1 Ad^T + C2 with Ad of T_2_1 = (I, -t), t = (0, 0, 5).
  PlaceMapper mapper({});
  const Eigen::Vector3d t(0, 0, 5);
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(1), link(0, pose({0, 0, 0}, {0, 0, 1}), 0.1, 0.02), {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(2), link(1, pose({0, 0, 0}, t), 0.3, 0.01), {}, kDepth_m);
  const PlaceGraph graph = mapper.place_graph();
  ASSERT_EQ(graph.constraints.size(), 1u);
  const RelativePoseConstraint& c = graph.constraints[0];
  EXPECT_EQ(c.from, NodeId(0));
  EXPECT_EQ(c.to, NodeId(1));
  EXPECT_EQ(c.source, ConstraintSource::kOdometry);
  EXPECT_LT(distance_m(std::get<SE3>(c.T_from_to), pose({0, 0, 0}, {0, 0, 6})), 1e-12);
  Matrix6d expected = Matrix6d::Zero();
  // Forward only the lengths add; sideways the turn of the first link swings the second one by 5 m.
  expected.diagonal() << 0.01 + 25 * 0.0004 + 0.09, 0.01 + 25 * 0.0004 + 0.09, 0.01 + 0.09,
      0.0004 + 0.0001, 0.0004 + 0.0001, 0.0004 + 0.0001;
  // A turn w about y moves the end by w x t = (5 w, 0, 0), about x by (0, -5 w, 0).
  expected(0, 4) = expected(4, 0) = 5 * 0.0004;
  expected(1, 3) = expected(3, 1) = -5 * 0.0004;
  const Matrix6d covariance = Matrix6d(c.information).inverse();
  EXPECT_LT((covariance - expected).cwiseAbs().maxCoeff(), 1e-9) << covariance;
}

TEST(PlaceMapper, KeepsASharpLinkSharp) {
  PlaceMapper mapper({});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(1), link(0, kLong, 1e-3, 1e-5), {}, kDepth_m);
  const Matrix6d information = mapper.place_graph().constraints.at(0).information;
  EXPECT_NEAR(information(5, 5) * 1e-10, 1, 1e-3);
  EXPECT_NEAR(information(0, 0) * 1e-6, 1, 1e-3);
}

TEST(PlaceMapper, BeginsEachComponentWithFreshCovariance) {
  PlaceMapper mapper({});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(1), link(0, kShort, 5, 1), {},
                      kDepth_m);  // a member: no constraint yet
  mapper.add_keyframe(KeyframeId(2), std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(3), link(2, kLong, 0.1, 0.01), {}, kDepth_m);
  const PlaceGraph graph = mapper.place_graph();
  ASSERT_EQ(graph.constraints.size(), 1u);
  EXPECT_NEAR(graph.constraints[0].information(5, 5), 1e4, 1);
}

TEST(PlaceMapper, MovesPlacesAndAllThatHangsOnThemWhenALoopCloses) {
  PlaceMapper mapper = square();
  ASSERT_EQ(mapper.place_of(KeyframeId(5)), mapper.place_of(KeyframeId(4)));
  ASSERT_GT(mapper.T_map_keyframe(KeyframeId(4)).translation().norm(), 0.3);
  mapper.add_loop(loop(4, 0, SE3(), 0.01, 0.001));
  const PlaceGraph graph = optimized(mapper);
  EXPECT_EQ(graph.constraints.back().source, ConstraintSource::kLoop);
  EXPECT_LT(mapper.T_map_keyframe(KeyframeId(4)).translation().norm(), 0.05);
  EXPECT_LT(angle_rad(mapper.T_map_keyframe(KeyframeId(4)), SE3()), 0.01);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(0)), SE3()), 1e-12);
  // The member moved with its anchor; odometry is untouched.
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(4)).inverse() *
                           mapper.T_map_keyframe(KeyframeId(5)),
                       kShort),
            1e-9);
  EXPECT_GT(mapper.odometry(KeyframeId(0), KeyframeId(4))->T_a_b.translation().norm(), 0.3);
  EXPECT_LT(distance_m(graph.places.back().T_map_place, mapper.T_map_keyframe(KeyframeId(4))),
            1e-12);
}

TEST(PlaceMapper, CarriesALoopBetweenMembersToTheirAnchors) {
  PlaceMapper mapper = square();
  const SE3 T_0_5 = pose({0, 0.1, 0}, {0.3, 0, 0.4});
  mapper.add_loop(loop(5, 0, T_0_5, 0.001, 0.0001));
  (void)optimized(mapper);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(0)).inverse() *
                           mapper.T_map_keyframe(KeyframeId(5)),
                       T_0_5),
            0.01);
  // A loop inside one place says nothing new.
  const std::size_t before = mapper.place_graph().constraints.size();
  mapper.add_loop(loop(5, 4, kShort, 0.001, 0.0001));
  EXPECT_EQ(mapper.place_graph().constraints.size(), before);
}

TEST(PlaceMapper, ALoopThatComesAfterAnOptimizationCountsInTheNext) {
  PlaceMapper mapper = square();
  (void)optimized(mapper);
  (void)mapper.take_constraint_changes();
  ASSERT_GT(mapper.T_map_keyframe(KeyframeId(4)).translation().norm(), 0.3);
  mapper.add_loop(loop(4, 0, SE3(), 0.01, 0.001));
  const auto changes = mapper.take_constraint_changes();
  ASSERT_FALSE(changes.empty());
  EXPECT_EQ(changes.back().constraint->source, ConstraintSource::kLoop);
  (void)optimized(mapper);
  EXPECT_LT(mapper.T_map_keyframe(KeyframeId(4)).translation().norm(), 0.05);
}

TEST(PlaceMapper, BringsComponentsTogetherByALoop) {
  PlaceMapper mapper({});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(1), link(0, kLong), {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(2), std::nullopt, pose({0, 1, 0}, {50, 0, 0}), kDepth_m);
  mapper.add_keyframe(KeyframeId(3), link(2, kLong), {}, kDepth_m);
  EXPECT_EQ(mapper.component_of(KeyframeId(1)), 0);
  EXPECT_EQ(mapper.component_of(KeyframeId(3)), 1);
  EXPECT_FALSE(mapper.odometry(KeyframeId(1), KeyframeId(3)));
  const SE3 T_1_3 = pose({0, -0.1, 0}, {1, 0, 2});
  mapper.add_loop(loop(3, 1, T_1_3, 0.02, 0.002));
  (void)optimized(mapper);
  EXPECT_EQ(mapper.component_of(KeyframeId(3)), 0);
  EXPECT_EQ(mapper.component_of(KeyframeId(2)), 0);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(3)), kLong * T_1_3), 1e-6);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(2)), kLong * T_1_3 * kLong.inverse()),
            1e-6);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(0)), SE3()), 1e-12);
}

TEST(PlaceMapper, HangsANewRunOnTheOldOneByABridge) {
  PlaceMapper mapper({});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  PlaceMapper::Link bridge = link(0, kLong);
  bridge.source = ConstraintSource::kOther;
  mapper.add_keyframe(KeyframeId(1), bridge, pose({0, 0, 0}, {9, 9, 9}), kDepth_m);
  mapper.add_keyframe(KeyframeId(2), link(1, kLong), {}, kDepth_m);
  EXPECT_EQ(mapper.component_of(KeyframeId(1)), 0);
  EXPECT_FALSE(mapper.odometry(KeyframeId(0), KeyframeId(1)));  // the bridge is no odometry
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(2)), kLong * kLong), 1e-12);
  const PlaceGraph graph = mapper.place_graph();
  ASSERT_EQ(graph.constraints.size(), 2u);
  EXPECT_EQ(graph.constraints[0].source, ConstraintSource::kOther);
  EXPECT_LT((graph.constraints[0].information - bridge.information).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(
      (graph.constraints[1].information - bridge.information).norm() / bridge.information.norm(),
      1e-9);
}

TEST(PlaceMapper, TakesOverANewerEstimateOfALink) {
  PlaceMapper mapper({});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(1), link(0, kShort), {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(2), link(1, kLong), {}, kDepth_m);
  const SE3 newer_short = pose({0, 0.03, 0}, {0, 0, 0.6}), newer_long = pose({0, 0, 0}, {0, 0, 6});
  mapper.update_link(KeyframeId(1), newer_short);
  mapper.update_link(KeyframeId(2), newer_long);
  mapper.inform_link(KeyframeId(1), information_of(0.2, 0.02));
  mapper.inform_link(KeyframeId(2), information_of(0.2, 0.02));
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(1)), newer_short), 1e-12);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(2)), newer_short * newer_long), 1e-12);
  EXPECT_LT(
      distance_m(mapper.odometry(KeyframeId(0), KeyframeId(2))->T_a_b, newer_short * newer_long),
      1e-12);
  const auto constraint = mapper.place_graph().constraints.at(0);
  EXPECT_LT(distance_m(std::get<SE3>(constraint.T_from_to), newer_short * newer_long), 1e-12);
  EXPECT_LT(constraint.information(2, 2), 1 / (0.2 * 0.2));
  EXPECT_THROW(mapper.update_link(KeyframeId(0), newer_short), ArgumentError);
  EXPECT_THROW(mapper.inform_link(KeyframeId(0), information_of(1, 1)), ArgumentError);
}

TEST(PlaceMapper, GrowsARunAboutItsFirstKeyframe) {
  PlaceMapper mapper({});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(1), link(0, kLong), {}, kDepth_m);
  const SE3 T_map_2 = pose({0, 1, 0}, {50, 0, 0});
  mapper.add_keyframe(KeyframeId(2), std::nullopt, T_map_2, kDepth_m);
  mapper.add_keyframe(KeyframeId(3), link(2, kShort), {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(4), link(3, kLong), {}, kDepth_m);
  mapper.rescale(KeyframeId(2), 3);
  const auto grown = [](const SE3& T) { return T.scaled(3); };
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(1)), kLong), 1e-12);  // another run
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(2)), T_map_2), 1e-12);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(3)), T_map_2 * grown(kShort)), 1e-9);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(4)), T_map_2 * grown(kShort * kLong)),
            1e-9);
  EXPECT_LT(distance_m(mapper.odometry(KeyframeId(2), KeyframeId(4))->T_a_b, grown(kShort * kLong)),
            1e-9);
}

TEST(PlaceMapper, ABridgeTellsTheRatioOfUnitsWhenOneOfThemIsMeasured) {
  // Two runs of one eye, the second hung on the first in its unit; then one of them turns out to
  // have had a unit of 2 m.
  for (const std::int64_t measured : {0, 5}) {
    PlaceMapper mapper({});
    const SE3 step = pose({0, 0, 0}, {5, 0, 0});
    mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m, false);
    for (int i = 1; i < 10; ++i) {
      PlaceMapper::Link to_previous = link(i - 1, step, 0.01, 0.001);
      to_previous.sigma_log_scale = 0.01;
      if (i == 5) to_previous.source = ConstraintSource::kOther;
      mapper.add_keyframe(KeyframeId(i), to_previous, {}, kDepth_m, false);
    }
    (void)mapper.finish();
    mapper.rescale(KeyframeId(measured), 2);
    (void)mapper.finish();
    EXPECT_TRUE(mapper.metric());
    // The way between the two ends, in metres, whichever run the metre came from.
    EXPECT_NEAR((mapper.T_map_keyframe(KeyframeId(9)).translation() -
                 mapper.T_map_keyframe(KeyframeId(0)).translation())
                    .norm(),
                90, 0.1)
        << measured;
    EXPECT_NEAR(mapper.S_map_keyframe(KeyframeId(measured)).scale(), 1, 1e-3);
    EXPECT_NEAR(mapper.S_map_keyframe(KeyframeId(5 - measured)).scale(), 2, 1e-2);
  }
}

TEST(PlaceMapper, ARunOfUnknownScalePublishesAllConstraintsAgain) {
  PlaceMapper mapper = square();
  EXPECT_EQ(mapper.take_constraint_changes().size(), 4u);
  mapper.add_keyframe(KeyframeId(6), std::nullopt, pose({0, 0, 0}, {50, 0, 0}), kDepth_m);
  EXPECT_TRUE(mapper.take_constraint_changes().empty());
  mapper.add_keyframe(KeyframeId(7), std::nullopt, pose({0, 0, 0}, {90, 0, 0}), kDepth_m, false);
  const auto changes = mapper.take_constraint_changes();
  ASSERT_EQ(changes.size(), 4u);
  for (const auto& change : changes)
    EXPECT_EQ(kind_of(change.constraint->T_from_to), PoseKind::kSim3);
  mapper.add_keyframe(KeyframeId(8), std::nullopt, pose({0, 0, 0}, {130, 0, 0}), kDepth_m, false);
  EXPECT_TRUE(mapper.take_constraint_changes().empty());
}

TEST(PlaceMapper, ARescaledMapIsOptimizedAndPublishedAsAWhole) {
  PlaceMapper mapper({});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m, false);
  mapper.add_keyframe(KeyframeId(1), link(0, kLong), {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(2), link(1, kLong), {}, kDepth_m);
  (void)mapper.optimize();
  ASSERT_TRUE(mapper.predicted(KeyframeId(0), KeyframeId(2)));
  (void)mapper.take_constraint_changes();
  mapper.rescale(KeyframeId(0), 2);
  EXPECT_FALSE(
      mapper.predicted(KeyframeId(0), KeyframeId(2)));  // the optimizer's lengths were others
  EXPECT_EQ(mapper.take_constraint_changes().size(), 2u);
  (void)mapper.optimize();
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(2)), (kLong * kLong).scaled(2)), 1e-6);
  EXPECT_NEAR(mapper.predicted(KeyframeId(0), KeyframeId(2))->path_length,
              4 * kLong.translation().norm(), 1e-6);
}

}  // namespace place_mapper_test
}  // namespace placegraph
