#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/place_mapper.h>

#include "tests/support/scene.h"

namespace placegraph {
namespace {

using namespace test;

Matrix6d information_of(double sigma_m, double sigma_rad) {
  Vector6d diagonal;
  diagonal.head<3>().setConstant(1 / (sigma_m * sigma_m));
  diagonal.tail<3>().setConstant(1 / (sigma_rad * sigma_rad));
  return diagonal.asDiagonal();
}

PlaceMapper::Link link(std::int64_t from, const SE3& T_from_this, double sigma_m = 0.05,
                       double sigma_rad = 0.005) {
  return {from, T_from_this, information_of(sigma_m, sigma_rad), ConstraintSource::kOdometry};
}

Loop loop(std::int64_t query, std::int64_t match, const SE3& T_match_query, double sigma_m,
          double sigma_rad) {
  Loop loop{query, match, T_match_query};
  loop.information.topLeftCorner<6, 6>() = information_of(sigma_m, sigma_rad);
  return loop;
}

/// One that tells the ratio of units too.
Loop scaled_loop(std::int64_t query, std::int64_t match, const SE3& T_match_query, double scale) {
  Loop result = loop(query, match, T_match_query, 0.01, 0.001);
  result.scale_match_query = scale;
  result.information(6, 6) = 1e4;
  return result;
}

const SE3 kShort = pose({0, 0.02, 0}, {0.1, 0, 0.5}), kLong = pose({0, 0.05, 0}, {0.2, 0, 5});
constexpr double kDepth_m = 10;  // a place reaches 3 m

PlaceGraph optimized(PlaceMapper& mapper) {
  const IncrementalStep step = mapper.finish();
  EXPECT_TRUE(step.outcome) << step.outcome.reason;
  return mapper.place_graph();
}

TEST(PlaceMapper, GathersNearKeyframesInOnePlace) {
  PlaceMapper mapper({});
  const SE3 T_map_first = pose({0, 0.3, 0}, {1, 2, 3});
  mapper.add_keyframe(0, std::nullopt, T_map_first, kDepth_m);
  mapper.add_keyframe(1, link(0, kShort), {}, kDepth_m);
  mapper.add_keyframe(2, link(1, kShort), {}, kDepth_m);
  mapper.add_keyframe(3, link(2, kLong), {}, kDepth_m);
  mapper.add_keyframe(4, link(3, pose({0, 0.5, 0}, {0, 0, 0.1})), {},
                      kDepth_m);  // turned by 29 deg
  const PlaceGraph graph = mapper.place_graph();
  ASSERT_EQ(graph.places.size(), 3u);
  ASSERT_EQ(graph.places[0].members.size(), 3u);
  EXPECT_EQ(graph.places[0].anchor_keyframe, 0);
  EXPECT_LT(distance_m(graph.places[0].members[0].T_place_keyframe, SE3()), 1e-12);
  EXPECT_LT(distance_m(graph.places[0].members[2].T_place_keyframe, kShort * kShort), 1e-12);
  EXPECT_EQ(mapper.place_of(2), 0);
  EXPECT_EQ(mapper.place_of(3), 1);
  EXPECT_EQ(mapper.place_of(4), 2);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(3), T_map_first * kShort * kShort * kLong), 1e-12);
  EXPECT_LT(distance_m(mapper.odometry(1, 3)->T_a_b, kShort * kLong), 1e-12);
  EXPECT_NEAR(mapper.odometry(3, 1)->way, kShort.translation().norm() + kLong.translation().norm(),
              1e-12);
  EXPECT_FALSE(mapper.odometry(0, 9));
  EXPECT_THROW(mapper.add_keyframe(4, std::nullopt, {}, kDepth_m), ArgumentError);
}

TEST(PlaceMapper, AddsUpTheCovariancesOfTheLinksBetweenAnchors) {
  // 0 -> 1 (a member) -> 2 (a new place), straight on, so that the sum can be written by hand:
  // C = Ad C1 Ad^T + C2 with Ad of T_2_1 = (I, -t), t = (0, 0, 5).
  PlaceMapper mapper({});
  const Eigen::Vector3d t(0, 0, 5);
  mapper.add_keyframe(0, std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(1, link(0, pose({0, 0, 0}, {0, 0, 1}), 0.1, 0.02), {}, kDepth_m);
  mapper.add_keyframe(2, link(1, pose({0, 0, 0}, t), 0.3, 0.01), {}, kDepth_m);
  const PlaceGraph graph = mapper.place_graph();
  ASSERT_EQ(graph.constraints.size(), 1u);
  const RelativePoseConstraint& c = graph.constraints[0];
  EXPECT_EQ(c.from, 0);
  EXPECT_EQ(c.to, 1);
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
  mapper.add_keyframe(0, std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(1, link(0, kLong, 1e-3, 1e-5), {}, kDepth_m);
  const Matrix6d information = mapper.place_graph().constraints.at(0).information;
  EXPECT_NEAR(information(5, 5) * 1e-10, 1, 1e-3);
  EXPECT_NEAR(information(0, 0) * 1e-6, 1, 1e-3);
}

TEST(PlaceMapper, BeginsEachComponentWithFreshCovariance) {
  PlaceMapper mapper({});
  mapper.add_keyframe(0, std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(1, link(0, kShort, 5, 1), {}, kDepth_m);  // a member: no constraint yet
  mapper.add_keyframe(2, std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(3, link(2, kLong, 0.1, 0.01), {}, kDepth_m);
  const PlaceGraph graph = mapper.place_graph();
  ASSERT_EQ(graph.constraints.size(), 1u);
  EXPECT_NEAR(graph.constraints[0].information(5, 5), 1e4, 1);
}

/// A square of 5 m sides whose odometry turns a little too much: keyframes 0 to 4, the last back at
/// the first; 5 hangs on the place of 4.
PlaceMapper square(bool merge = false) {
  PlaceOptions options;
  options.merge = merge;
  PlaceMapper mapper(options);
  const SE3 side = pose({0, M_PI / 2 + 0.04, 0}, {0, 0, 5.2});
  mapper.add_keyframe(0, std::nullopt, {}, kDepth_m);
  for (int i = 1; i <= 4; ++i) mapper.add_keyframe(i, link(i - 1, side, 0.1, 0.03), {}, kDepth_m);
  mapper.add_keyframe(5, link(4, kShort), {}, kDepth_m);
  return mapper;
}

TEST(PlaceMapper, MovesPlacesAndAllThatHangsOnThemWhenALoopCloses) {
  PlaceMapper mapper = square();
  ASSERT_EQ(mapper.place_of(5), mapper.place_of(4));
  ASSERT_GT(mapper.T_map_keyframe(4).translation().norm(), 0.3);
  mapper.add_loop(loop(4, 0, SE3(), 0.01, 0.001));
  const PlaceGraph graph = optimized(mapper);
  EXPECT_EQ(graph.constraints.back().source, ConstraintSource::kLoop);
  EXPECT_LT(mapper.T_map_keyframe(4).translation().norm(), 0.05);
  EXPECT_LT(angle_rad(mapper.T_map_keyframe(4), SE3()), 0.01);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(0), SE3()), 1e-12);
  // The member moved with its anchor; odometry is untouched.
  EXPECT_LT(distance_m(mapper.T_map_keyframe(4).inverse() * mapper.T_map_keyframe(5), kShort),
            1e-9);
  EXPECT_GT(mapper.odometry(0, 4)->T_a_b.translation().norm(), 0.3);
  EXPECT_LT(distance_m(graph.places.back().T_map_place, mapper.T_map_keyframe(4)), 1e-12);
}

TEST(PlaceMapper, CarriesALoopBetweenMembersToTheirAnchors) {
  PlaceMapper mapper = square();
  const SE3 T_0_5 = pose({0, 0.1, 0}, {0.3, 0, 0.4});
  mapper.add_loop(loop(5, 0, T_0_5, 0.001, 0.0001));
  (void)optimized(mapper);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(0).inverse() * mapper.T_map_keyframe(5), T_0_5), 0.01);
  // A loop inside one place says nothing new.
  const std::size_t before = mapper.place_graph().constraints.size();
  mapper.add_loop(loop(5, 4, kShort, 0.001, 0.0001));
  EXPECT_EQ(mapper.place_graph().constraints.size(), before);
}

TEST(PlaceMapper, BringsComponentsTogetherByALoop) {
  PlaceMapper mapper({});
  mapper.add_keyframe(0, std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(1, link(0, kLong), {}, kDepth_m);
  mapper.add_keyframe(2, std::nullopt, pose({0, 1, 0}, {50, 0, 0}), kDepth_m);
  mapper.add_keyframe(3, link(2, kLong), {}, kDepth_m);
  EXPECT_EQ(mapper.component_of(1), 0);
  EXPECT_EQ(mapper.component_of(3), 1);
  EXPECT_FALSE(mapper.odometry(1, 3));
  const SE3 T_1_3 = pose({0, -0.1, 0}, {1, 0, 2});
  mapper.add_loop(loop(3, 1, T_1_3, 0.02, 0.002));
  (void)optimized(mapper);
  EXPECT_EQ(mapper.component_of(3), 0);
  EXPECT_EQ(mapper.component_of(2), 0);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(3), kLong * T_1_3), 1e-6);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(2), kLong * T_1_3 * kLong.inverse()), 1e-6);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(0), SE3()), 1e-12);
}

TEST(PlaceMapper, HangsANewRunOnTheOldOneByABridge) {
  PlaceMapper mapper({});
  mapper.add_keyframe(0, std::nullopt, {}, kDepth_m);
  PlaceMapper::Link bridge = link(0, kLong);
  bridge.source = ConstraintSource::kOther;
  mapper.add_keyframe(1, bridge, pose({0, 0, 0}, {9, 9, 9}), kDepth_m);
  mapper.add_keyframe(2, link(1, kLong), {}, kDepth_m);
  EXPECT_EQ(mapper.component_of(1), 0);
  EXPECT_FALSE(mapper.odometry(0, 1));  // the bridge is no odometry
  EXPECT_LT(distance_m(mapper.T_map_keyframe(2), kLong * kLong), 1e-12);
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
  mapper.add_keyframe(0, std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(1, link(0, kShort), {}, kDepth_m);
  mapper.add_keyframe(2, link(1, kLong), {}, kDepth_m);
  const SE3 newer_short = pose({0, 0.03, 0}, {0, 0, 0.6}), newer_long = pose({0, 0, 0}, {0, 0, 6});
  mapper.update_link(1, newer_short);
  mapper.update_link(2, newer_long);
  mapper.inform_link(1, information_of(0.2, 0.02));
  mapper.inform_link(2, information_of(0.2, 0.02));
  EXPECT_LT(distance_m(mapper.T_map_keyframe(1), newer_short), 1e-12);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(2), newer_short * newer_long), 1e-12);
  EXPECT_LT(distance_m(mapper.odometry(0, 2)->T_a_b, newer_short * newer_long), 1e-12);
  const auto constraint = mapper.place_graph().constraints.at(0);
  EXPECT_LT(distance_m(std::get<SE3>(constraint.T_from_to), newer_short * newer_long), 1e-12);
  EXPECT_LT(constraint.information(2, 2), 1 / (0.2 * 0.2));
  EXPECT_THROW(mapper.update_link(0, newer_short), ArgumentError);
  EXPECT_THROW(mapper.inform_link(0, information_of(1, 1)), ArgumentError);
}

TEST(PlaceMapper, GrowsARunAboutItsFirstKeyframe) {
  PlaceMapper mapper({});
  mapper.add_keyframe(0, std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(1, link(0, kLong), {}, kDepth_m);
  const SE3 T_map_2 = pose({0, 1, 0}, {50, 0, 0});
  mapper.add_keyframe(2, std::nullopt, T_map_2, kDepth_m);
  mapper.add_keyframe(3, link(2, kShort), {}, kDepth_m);
  mapper.add_keyframe(4, link(3, kLong), {}, kDepth_m);
  mapper.rescale(2, 3);
  const auto grown = [](const SE3& T) { return SE3(T.rotation(), 3 * T.translation()); };
  EXPECT_LT(distance_m(mapper.T_map_keyframe(1), kLong), 1e-12);  // another run
  EXPECT_LT(distance_m(mapper.T_map_keyframe(2), T_map_2), 1e-12);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(3), T_map_2 * grown(kShort)), 1e-9);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(4), T_map_2 * grown(kShort * kLong)), 1e-9);
  EXPECT_LT(distance_m(mapper.odometry(2, 4)->T_a_b, grown(kShort * kLong)), 1e-9);
}

constexpr std::int64_t kAll = 1000;  // no keyframe is being refined any more

TEST(PlaceMapper, GrowsToTheSameOptimumAsTheWholeGraphAtOnce) {
  const SE3 side = pose({0, M_PI / 2 + 0.04, 0}, {0, 0, 5.2});
  PlaceOptions apart;
  apart.merge = false;
  PlaceMapper growing(apart), whole(apart);
  for (PlaceMapper* mapper : {&growing, &whole}) {
    const auto step = [&] {
      if (mapper == &growing) {
        EXPECT_TRUE(mapper->optimize().outcome);
      }
    };
    mapper->add_keyframe(0, std::nullopt, {}, kDepth_m);
    for (int i = 1; i <= 8; ++i) {
      mapper->add_keyframe(i, link(i - 1, side, 1, 0.5), {}, kDepth_m);
      step();
      mapper->update_link(i, side * pose({0, 0, 0.001 * i}, {0, 0, 0.1}));  // the window went on
      mapper->inform_link(i, information_of(0.1, 0.03));
      if (i == 5) mapper->inform_anchor(5, information_of(0.05, 0.02));
      if (i >= 4) mapper->add_loop(loop(i, i - 4, pose({0, 0, 0.01}, {0.1, 0, 0}), 0.02, 0.002));
      step();
    }
    EXPECT_TRUE(mapper->finish().outcome);
  }
  for (int i = 0; i <= 8; ++i) {
    EXPECT_LT(distance_m(growing.T_map_keyframe(i), whole.T_map_keyframe(i)), 1e-4) << i;
    EXPECT_LT(angle_rad(growing.T_map_keyframe(i), whole.T_map_keyframe(i)), 1e-5) << i;
  }
  EXPECT_EQ(growing.place_graph().constraints.size(), 13u);
}

TEST(PlaceMapper, PredictsHowTwoKeyframesLieAndHowWellThatIsKnown) {
  PlaceMapper mapper = square();
  EXPECT_FALSE(mapper.predicted(0, 4));  // nothing was optimized yet
  (void)mapper.optimize();
  const auto chain = mapper.predicted(0, 5);
  ASSERT_TRUE(chain);
  EXPECT_LT(distance_m(SE3(chain->S_a_b.rotation(), chain->S_a_b.translation()),
                       mapper.T_map_keyframe(0).inverse() * mapper.T_map_keyframe(5)),
            1e-9);
  // Four links of 0.03 rad: each axis of the rotation has four times the variance of one.
  const auto rotation = [](const PredictedMotion& motion) {
    return motion.covariance.diagonal().segment<3>(3).sum();
  };
  EXPECT_NEAR(rotation(*chain), 4 * 3 * 0.03 * 0.03, 1e-6);
  EXPECT_NEAR(chain->way, 4 * 5.2, 1e-6);
  mapper.add_loop(loop(4, 0, SE3(), 0.01, 0.001));
  (void)mapper.optimize();
  const auto closed = mapper.predicted(0, 5);
  ASSERT_TRUE(closed);
  EXPECT_LT(rotation(*closed), 3.1 * 0.001 * 0.001);
  EXPECT_LT(closed->way, 0.1);
  EXPECT_EQ(mapper.predicted(4, 5)->covariance.norm(), 0);  // of one place
  mapper.add_keyframe(6, std::nullopt, pose({0, 0, 0}, {50, 0, 0}), kDepth_m);
  (void)mapper.optimize();
  EXPECT_FALSE(mapper.predicted(0, 6));  // nothing joins them
}

TEST(PlaceMapper, MergesPlacesThatALoopShowsToBeOne) {
  PlaceMapper mapper = square(true);
  const SE3 T_0_4 = pose({0, 0.02, 0}, {0.1, 0, 0.2});
  mapper.add_loop(loop(4, 0, T_0_4, 0.01, 0.001));
  const IncrementalStep step = mapper.finish();
  ASSERT_TRUE(step.outcome) << step.outcome.reason;
  const PlaceGraph graph = mapper.place_graph();
  // Five corners were places; the fifth is the first, and what hung on it came along.
  ASSERT_EQ(graph.places.size(), 4u);
  EXPECT_EQ(mapper.place_of(4), 0);
  EXPECT_EQ(mapper.place_of(5), 0);
  ASSERT_EQ(graph.places[0].members.size(), 3u);
  EXPECT_EQ(graph.places[0].members[0].keyframe, 0);
  EXPECT_EQ(graph.places[0].members[1].keyframe, 4);
  // Little moved: every keyframe is near where the optimum with the place of its own has it.
  PlaceMapper apart = square(false);
  apart.add_loop(loop(4, 0, T_0_4, 0.01, 0.001));
  (void)optimized(apart);
  for (int id = 0; id <= 5; ++id) {
    EXPECT_LT(distance_m(mapper.T_map_keyframe(id), apart.T_map_keyframe(id)), 2e-3) << id;
    EXPECT_LT(angle_rad(mapper.T_map_keyframe(id), apart.T_map_keyframe(id)), 5e-4) << id;
  }
  // The last side now ends at the first place, and the loop is inside it.
  ASSERT_EQ(graph.constraints.size(), 4u);
  const RelativePoseConstraint& last = graph.constraints[3];
  EXPECT_EQ(last.from, 3);
  EXPECT_EQ(last.to, 0);
  const SE3 side = pose({0, M_PI / 2 + 0.04, 0}, {0, 0, 5.2});
  const SE3 T_place_4 = graph.places[0].members[1].T_place_keyframe;
  EXPECT_LT(distance_m(std::get<SE3>(last.T_from_to), side * T_place_4.inverse()), 1e-9);
  // Less is known of it than of the side alone: where 4 stands in its place adds its share.
  const Matrix6d covariance = Matrix6d(last.information).inverse();
  const double variance = covariance.diagonal().tail<3>().sum();
  EXPECT_GT(variance, 3 * 0.03 * 0.03);
  EXPECT_LT(variance, 3.1 * 0.03 * 0.03);
  // The optimum stays where it is.
  const SE3 before = mapper.T_map_keyframe(2);
  (void)optimized(mapper);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(2), before), 0.02);
}

TEST(PlaceMapper, DoesNotMergeWhatIsBeingRefinedOrFarAwayOrPoorlyKnown) {
  const auto places_after = [](const Loop& seen, std::int64_t first_open) {
    PlaceMapper mapper = square(true);
    mapper.add_loop(seen);
    EXPECT_TRUE(mapper.optimize(first_open).outcome);
    return mapper.place_graph().places.size();
  };
  const SE3 near = pose({0, 0, 0}, {0, 0, 0.2});
  EXPECT_EQ(places_after(loop(4, 0, near, 0.01, 0.001), kAll), 4u);
  EXPECT_EQ(places_after(loop(4, 0, near, 0.01, 0.001), 5), 5u);  // 5 is open
  EXPECT_EQ(places_after(loop(4, 0, pose({0, 0, 0}, {0, 0, 3.2}), 0.01, 0.001), kAll), 5u);
  EXPECT_EQ(places_after(loop(4, 0, pose({0, 0.5, 0}, {0, 0, 0.2}), 0.01, 0.001), kAll), 5u);
  EXPECT_EQ(places_after(loop(4, 0, near, 2, 0.2), kAll), 5u);
}

TEST(PlaceMapper, TakesTheInformationOfTheWholeWayBetweenAnchorsWhereItIsKnown) {
  PlaceMapper mapper({});
  mapper.add_keyframe(0, std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(1, link(0, kShort), {}, kDepth_m);
  mapper.add_keyframe(2, link(1, kLong), {}, kDepth_m);
  EXPECT_EQ(mapper.previous_anchor(2), 0);
  EXPECT_FALSE(mapper.previous_anchor(1));  // a member
  EXPECT_FALSE(mapper.previous_anchor(0));  // the first
  Matrix6d information = information_of(0.02, 0.003);
  information(0, 4) = information(4, 0) = 100;
  mapper.inform_anchor(2, information);
  const auto constraint = mapper.place_graph().constraints.at(0);
  EXPECT_LT((constraint.information - information).norm() / information.norm(), 1e-9);
  EXPECT_THROW(mapper.inform_anchor(1, information), ArgumentError);
}

/// Four sides of a square of 5 m, each measured in a unit that has grown by a tenth: the last side
/// seems 5 / 1.1^3 long. 4 is back at 0.
PlaceMapper shrinking_square() {
  PlaceOptions options;
  options.merge = false;
  PlaceMapper mapper(options);
  mapper.add_keyframe(0, std::nullopt, {}, kDepth_m, false);
  for (int i = 1; i <= 4; ++i) {
    auto side = link(i - 1, pose({0, M_PI / 2, 0}, {0, 0, 5 / std::pow(1.1, i - 1)}), 0.01, 0.001);
    side.sigma_log_scale = 0.05;
    mapper.add_keyframe(i, side, {}, kDepth_m);
  }
  return mapper;
}

TEST(PlaceMapper, ClosesScaleDriftByALoopThatTellsTheRatioOfUnits) {
  PlaceMapper mapper = shrinking_square();
  ASSERT_GT(mapper.T_map_keyframe(4).translation().norm(), 0.8);
  mapper.add_loop(scaled_loop(4, 0, SE3(), std::pow(1.1, 4)));
  const PlaceGraph graph = optimized(mapper);
  EXPECT_EQ(kind_of(graph.constraints[0].T_from_to), PoseKind::kSim3);
  const SE3 corner = pose({0, M_PI / 2, 0}, {0, 0, 5});
  SE3 truth;
  for (int i = 0; i <= 4; ++i, truth = truth * corner) {
    EXPECT_LT(distance_m(mapper.T_map_keyframe(i), truth), 0.02) << i;
    EXPECT_NEAR(std::log(graph.places[i].scale), i * std::log(1.1), 0.01) << i;
    // A landmark 2 m ahead of every corner, as long as its unit made it there.
    const Eigen::Vector3d seen(0, 0, 2 / std::pow(1.1, i));
    EXPECT_LT((mapper.S_map_keyframe(i) * seen - truth * Eigen::Vector3d(0, 0, 2)).norm(), 0.03);
  }
  EXPECT_FALSE(mapper.metric());
}

TEST(PlaceMapper, JoinsComponentsOfUnknownRatioByALoop) {
  // The second drive is the first one in units of 2.5 m.
  PlaceMapper mapper({});
  mapper.add_keyframe(0, std::nullopt, {}, kDepth_m, false);
  mapper.add_keyframe(1, link(0, kLong), {}, kDepth_m);
  const SE3 start = pose({0, 1, 0}, {50, 0, 0});
  mapper.add_keyframe(2, std::nullopt, start, kDepth_m / 2.5, false);
  const SE3 way(kLong.rotation(), kLong.translation() / 2.5);
  mapper.add_keyframe(3, link(2, way), {}, kDepth_m / 2.5);
  mapper.add_loop(scaled_loop(3, 1, SE3(), 2.5));
  const PlaceGraph graph = optimized(mapper);
  EXPECT_EQ(mapper.component_of(3), 0);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(3), kLong), 1e-6);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(2), SE3()), 1e-6);
  EXPECT_NEAR(graph.places[2].scale, 2.5, 1e-6);
}

TEST(PlaceMapper, GivesAJoinedMapTheUnitThatAPartOfItMeasured) {
  PlaceOptions options;
  options.merge = false;
  PlaceMapper mapper(options);
  mapper.add_keyframe(0, std::nullopt, {}, kDepth_m, false);
  mapper.add_keyframe(1, link(0, kLong), {}, kDepth_m);
  mapper.add_keyframe(2, std::nullopt, {}, kDepth_m, true);
  mapper.add_keyframe(3, link(2, kLong), {}, kDepth_m);
  EXPECT_FALSE(mapper.metric());
  // One unit of the first drive is 0.4 m.
  mapper.add_loop(scaled_loop(2, 0, SE3(), 2.5));
  const PlaceGraph graph = optimized(mapper);
  EXPECT_TRUE(mapper.metric());
  EXPECT_NEAR(graph.places[0].scale, 0.4, 1e-3);
  EXPECT_NEAR(graph.places[2].scale, 1, 1e-3);
  EXPECT_NEAR(mapper.T_map_keyframe(1).translation().norm(), 0.4 * kLong.translation().norm(),
              1e-2);
  EXPECT_NEAR(mapper.T_map_keyframe(3).translation().norm(), kLong.translation().norm(), 1e-2);
}

TEST(PlaceMapper, KeepsALateMeasuredRunWhereALoopHasPutIt) {
  PlaceMapper mapper({});
  mapper.add_keyframe(0, std::nullopt, {}, kDepth_m, false);
  mapper.add_keyframe(1, link(0, kLong), {}, kDepth_m);
  mapper.add_keyframe(2, std::nullopt, {}, kDepth_m / 2.5, false);
  const SE3 way(kLong.rotation(), kLong.translation() / 2.5);
  mapper.add_keyframe(3, link(2, way), {}, kDepth_m / 2.5);
  mapper.add_loop(scaled_loop(3, 1, SE3(), 2.5));
  (void)optimized(mapper);
  const SE3 before = mapper.T_map_keyframe(3);
  mapper.rescale(2, 2.5);  // its unit was 2.5 m
  EXPECT_LT(distance_m(mapper.T_map_keyframe(3), before), 1e-9);
  EXPECT_LT(distance_m(mapper.odometry(2, 3)->T_a_b, kLong), 1e-9);
  EXPECT_NEAR(mapper.S_map_keyframe(3).scale(), 1, 1e-6);
  (void)optimized(mapper);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(3), before), 1e-4);
  EXPECT_TRUE(mapper.metric());
}

}  // namespace
}  // namespace placegraph
