#include <numbers>

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/places/place_mapper.h>

#include "tests/support/place_links.h"

namespace placegraph {
namespace place_mapper_optimization_test {

using namespace test;

constexpr KeyframeId kAll(1000);  // no keyframe is being refined any more

TEST(PlaceOptimization, GrowsToTheSameOptimumAsTheWholeGraphAtOnce) {
  const SE3 side = pose({0, std::numbers::pi / 2 + 0.04, 0}, {0, 0, 5.2});
  PlaceOptions apart;
  apart.merge = false;
  PlaceMapper growing(apart), whole(apart);
  for (PlaceMapper* mapper : {&growing, &whole}) {
    const auto step = [&] {
      if (mapper == &growing) {
        EXPECT_TRUE(mapper->optimize().outcome);
      }
    };
    mapper->add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
    for (int i = 1; i <= 8; ++i) {
      mapper->add_keyframe(KeyframeId(i), link(i - 1, side, 1, 0.5), {}, kDepth_m);
      step();
      mapper->update_link(KeyframeId(i),
                          side * pose({0, 0, 0.001 * i}, {0, 0, 0.1}));  // the window went on
      mapper->inform_link(KeyframeId(i), information_of(0.1, 0.03));
      if (i == 5) mapper->inform_anchor(KeyframeId(5), information_of(0.05, 0.02));
      if (i >= 4) mapper->add_loop(loop(i, i - 4, pose({0, 0, 0.01}, {0.1, 0, 0}), 0.02, 0.002));
      step();
    }
    EXPECT_TRUE(mapper->finish().outcome);
  }
  for (int i = 0; i <= 8; ++i) {
    EXPECT_LT(
        distance_m(growing.T_map_keyframe(KeyframeId(i)), whole.T_map_keyframe(KeyframeId(i))),
        1e-4)
        << i;
    EXPECT_LT(angle_rad(growing.T_map_keyframe(KeyframeId(i)), whole.T_map_keyframe(KeyframeId(i))),
              1e-5)
        << i;
  }
  EXPECT_EQ(growing.place_graph().constraints.size(), 13u);
}

TEST(PlaceOptimization, PredictsHowTwoKeyframesLieAndHowWellThatIsKnown) {
  PlaceMapper mapper = square();
  EXPECT_FALSE(mapper.predicted(KeyframeId(0), KeyframeId(4)));  // nothing was optimized yet
  (void)mapper.optimize();
  const auto chain = mapper.predicted(KeyframeId(0), KeyframeId(5));
  ASSERT_TRUE(chain);
  EXPECT_LT(distance_m(SE3(chain->S_a_b.rotation(), chain->S_a_b.translation()),
                       mapper.T_map_keyframe(KeyframeId(0)).inverse() *
                           mapper.T_map_keyframe(KeyframeId(5))),
            1e-9);
  // Four links of 0.03 rad: each axis of the rotation has four times the variance of one.
  const auto rotation = [](const PredictedMotion& motion) {
    return motion.covariance.diagonal().segment<3>(3).sum();
  };
  EXPECT_NEAR(rotation(*chain), 4 * 3 * 0.03 * 0.03, 1e-6);
  EXPECT_NEAR(chain->path_length, 4 * 5.2, 1e-6);
  mapper.add_loop(loop(4, 0, SE3(), 0.01, 0.001));
  (void)mapper.optimize();
  const auto closed = mapper.predicted(KeyframeId(0), KeyframeId(5));
  ASSERT_TRUE(closed);
  EXPECT_LT(rotation(*closed), 3.1 * 0.001 * 0.001);
  EXPECT_LT(closed->path_length, 0.1);
  EXPECT_EQ(mapper.predicted(KeyframeId(4), KeyframeId(5))->covariance.norm(), 0);  // of one place
  mapper.add_keyframe(KeyframeId(6), std::nullopt, pose({0, 0, 0}, {50, 0, 0}), kDepth_m);
  (void)mapper.optimize();
  EXPECT_FALSE(mapper.predicted(KeyframeId(0), KeyframeId(6)));  // nothing joins them
}

TEST(PlaceOptimization, MergesPlacesThatALoopShowsToBeOne) {
  PlaceMapper mapper = square(true);
  const SE3 T_0_4 = pose({0, 0.02, 0}, {0.1, 0, 0.2});
  mapper.add_loop(loop(4, 0, T_0_4, 0.01, 0.001));
  const IncrementalStep step = mapper.finish();
  ASSERT_TRUE(step.outcome) << step.outcome.reason;
  const PlaceGraph graph = mapper.place_graph();
  // Five corners were places; the fifth is the first, and what hung on it came along.
  ASSERT_EQ(graph.places.size(), 4u);
  EXPECT_EQ(mapper.place_of(KeyframeId(4)), PlaceId(0));
  EXPECT_EQ(mapper.place_of(KeyframeId(5)), PlaceId(0));
  ASSERT_EQ(graph.places[0].members.size(), 3u);
  EXPECT_EQ(graph.places[0].members[0].keyframe, KeyframeId(0));
  EXPECT_EQ(graph.places[0].members[1].keyframe, KeyframeId(4));
  // Little moved: every keyframe is near where the optimum with the place of its own has it.
  PlaceMapper apart = square(false);
  apart.add_loop(loop(4, 0, T_0_4, 0.01, 0.001));
  (void)optimized(apart);
  for (int id = 0; id <= 5; ++id) {
    EXPECT_LT(
        distance_m(mapper.T_map_keyframe(KeyframeId(id)), apart.T_map_keyframe(KeyframeId(id))),
        2e-3)
        << id;
    EXPECT_LT(
        angle_rad(mapper.T_map_keyframe(KeyframeId(id)), apart.T_map_keyframe(KeyframeId(id))),
        5e-4)
        << id;
  }
  // The last side now ends at the first place, and the loop is inside it.
  ASSERT_EQ(graph.constraints.size(), 4u);
  const RelativePoseConstraint& last = graph.constraints[3];
  EXPECT_EQ(last.from, NodeId(3));
  EXPECT_EQ(last.to, NodeId(0));
  const SE3 side = pose({0, std::numbers::pi / 2 + 0.04, 0}, {0, 0, 5.2});
  const SE3 T_place_4 = graph.places[0].members[1].T_place_keyframe;
  EXPECT_LT(distance_m(std::get<SE3>(last.T_from_to), side * T_place_4.inverse()), 1e-9);
  // Less is known of it than of the side alone: where 4 stands in its place adds its share.
  const Matrix6d covariance = Matrix6d(last.information).inverse();
  const double variance = covariance.diagonal().tail<3>().sum();
  EXPECT_GT(variance, 3 * 0.03 * 0.03);
  EXPECT_LT(variance, 3.1 * 0.03 * 0.03);
  // The optimum stays where it is.
  const SE3 before = mapper.T_map_keyframe(KeyframeId(2));
  (void)optimized(mapper);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(2)), before), 0.02);
}

TEST(PlaceOptimization, DoesNotMergeWhatIsBeingRefinedOrFarAwayOrPoorlyKnown) {
  const auto places_after = [](const Loop& seen, KeyframeId first_open) {
    PlaceMapper mapper = square(true);
    mapper.add_loop(seen);
    EXPECT_TRUE(mapper.optimize(first_open).outcome);
    return mapper.place_graph().places.size();
  };
  const SE3 near = pose({0, 0, 0}, {0, 0, 0.2});
  EXPECT_EQ(places_after(loop(4, 0, near, 0.01, 0.001), kAll), 4u);
  EXPECT_EQ(places_after(loop(4, 0, near, 0.01, 0.001), KeyframeId(5)), 5u);  // 5 is open
  EXPECT_EQ(places_after(loop(4, 0, pose({0, 0, 0}, {0, 0, 3.2}), 0.01, 0.001), kAll), 5u);
  EXPECT_EQ(places_after(loop(4, 0, pose({0, 0.5, 0}, {0, 0, 0.2}), 0.01, 0.001), kAll), 5u);
  EXPECT_EQ(places_after(loop(4, 0, near, 2, 0.2), kAll), 5u);
}

TEST(PlaceOptimization, TakesTheInformationOfTheWholeWayBetweenAnchorsWhereItIsKnown) {
  PlaceMapper mapper({});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(1), link(0, kShort), {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(2), link(1, kLong), {}, kDepth_m);
  EXPECT_EQ(mapper.previous_anchor(KeyframeId(2)), KeyframeId(0));
  EXPECT_FALSE(mapper.previous_anchor(KeyframeId(1)));  // a member
  EXPECT_FALSE(mapper.previous_anchor(KeyframeId(0)));  // the first
  Matrix6d information = information_of(0.02, 0.003);
  information(0, 4) = information(4, 0) = 100;
  mapper.inform_anchor(KeyframeId(2), information);
  const auto constraint = mapper.place_graph().constraints.at(0);
  EXPECT_LT((constraint.information - information).norm() / information.norm(), 1e-9);
  EXPECT_THROW(mapper.inform_anchor(KeyframeId(1), information), ArgumentError);
}

/// Four sides of a square of 5 m, each measured in a unit that has grown by a tenth: the last side
/// seems 5 / 1.1^3 long. 4 is back at 0.
PlaceMapper shrinking_square() {
  PlaceOptions options;
  options.merge = false;
  PlaceMapper mapper(options);
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m, false);
  for (int i = 1; i <= 4; ++i) {
    auto side = link(i - 1, pose({0, std::numbers::pi / 2, 0}, {0, 0, 5 / std::pow(1.1, i - 1)}),
                     0.01, 0.001);
    side.sigma_log_scale = 0.05;
    mapper.add_keyframe(KeyframeId(i), side, {}, kDepth_m);
  }
  return mapper;
}

TEST(PlaceOptimization, ClosesScaleDriftByALoopThatTellsTheRatioOfUnits) {
  PlaceMapper mapper = shrinking_square();
  ASSERT_GT(mapper.T_map_keyframe(KeyframeId(4)).translation().norm(), 0.8);
  mapper.add_loop(scaled_loop(4, 0, SE3(), std::pow(1.1, 4)));
  const PlaceGraph graph = optimized(mapper);
  EXPECT_EQ(kind_of(graph.constraints[0].T_from_to), PoseKind::kSim3);
  const SE3 corner = pose({0, std::numbers::pi / 2, 0}, {0, 0, 5});
  SE3 truth;
  for (int i = 0; i <= 4; ++i, truth = truth * corner) {
    EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(i)), truth), 0.02) << i;
    EXPECT_NEAR(std::log(graph.places[i].scale), i * std::log(1.1), 0.01) << i;
    // A landmark 2 m ahead of every corner, as long as its unit made it there.
    const Eigen::Vector3d seen(0, 0, 2 / std::pow(1.1, i));
    EXPECT_LT(
        (mapper.S_map_keyframe(KeyframeId(i)) * seen - truth * Eigen::Vector3d(0, 0, 2)).norm(),
        0.03);
  }
  EXPECT_FALSE(mapper.metric());
}

TEST(PlaceOptimization, JoinsComponentsOfUnknownRatioByALoop) {
  // The second drive is the first one in units of 2.5 m.
  PlaceOptions options;
  options.merge = false;
  PlaceMapper mapper(options);
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m, false);
  mapper.add_keyframe(KeyframeId(1), link(0, kLong), {}, kDepth_m);
  const SE3 start = pose({0, 1, 0}, {50, 0, 0});
  mapper.add_keyframe(KeyframeId(2), std::nullopt, start, kDepth_m / 2.5, false);
  const SE3 path(kLong.rotation(), kLong.translation() / 2.5);
  mapper.add_keyframe(KeyframeId(3), link(2, path), {}, kDepth_m / 2.5);
  mapper.add_loop(scaled_loop(3, 1, SE3(), 2.5));
  const PlaceGraph graph = optimized(mapper);
  EXPECT_EQ(mapper.component_of(KeyframeId(3)), 0);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(3)), kLong), 1e-6);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(2)), SE3()), 1e-6);
  EXPECT_NEAR(graph.places[2].scale, 2.5, 1e-6);
}

TEST(PlaceOptimization, GivesAJoinedMapTheUnitThatAPartOfItMeasured) {
  PlaceOptions options;
  options.merge = false;
  PlaceMapper mapper(options);
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m, false);
  mapper.add_keyframe(KeyframeId(1), link(0, kLong), {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(2), std::nullopt, {}, kDepth_m, true);
  mapper.add_keyframe(KeyframeId(3), link(2, kLong), {}, kDepth_m);
  EXPECT_FALSE(mapper.metric());
  // One unit of the first drive is 0.4 m.
  mapper.add_loop(scaled_loop(2, 0, SE3(), 2.5));
  const PlaceGraph graph = optimized(mapper);
  EXPECT_TRUE(mapper.metric());
  EXPECT_NEAR(graph.places[0].scale, 0.4, 1e-3);
  EXPECT_NEAR(graph.places[2].scale, 1, 1e-3);
  EXPECT_NEAR(mapper.T_map_keyframe(KeyframeId(1)).translation().norm(),
              0.4 * kLong.translation().norm(), 1e-2);
  EXPECT_NEAR(mapper.T_map_keyframe(KeyframeId(3)).translation().norm(), kLong.translation().norm(),
              1e-2);
}

TEST(PlaceOptimization, KeepsALateMeasuredRunWhereALoopHasPutIt) {
  PlaceMapper mapper({});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m, false);
  mapper.add_keyframe(KeyframeId(1), link(0, kLong), {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(2), std::nullopt, {}, kDepth_m / 2.5, false);
  const SE3 path(kLong.rotation(), kLong.translation() / 2.5);
  mapper.add_keyframe(KeyframeId(3), link(2, path), {}, kDepth_m / 2.5);
  mapper.add_loop(scaled_loop(3, 1, SE3(), 2.5));
  (void)optimized(mapper);
  const SE3 before = mapper.T_map_keyframe(KeyframeId(3));
  mapper.rescale(KeyframeId(2), 2.5);  // its unit was 2.5 m
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(3)), before), 1e-9);
  EXPECT_LT(distance_m(mapper.odometry(KeyframeId(2), KeyframeId(3))->T_a_b, kLong), 1e-9);
  EXPECT_NEAR(mapper.S_map_keyframe(KeyframeId(3)).scale(), 1, 1e-6);
  (void)optimized(mapper);
  EXPECT_LT(distance_m(mapper.T_map_keyframe(KeyframeId(3)), before), 1e-4);
  EXPECT_TRUE(mapper.metric());
}

}  // namespace place_mapper_optimization_test
}  // namespace placegraph
