#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/route.h>

#include <algorithm>

#include "tests/support/ids.h"
#include "tests/support/message_of.h"

namespace placegraph {
namespace route_test {

/// Places 0 to 5 along x, two metres apart, each turned a little; a loop joins 1 and 4, which lies
/// beside it; place 9 stands alone.
PlaceGraph places() {
  PlaceGraph graph;
  const Eigen::Vector3d positions[] = {{0, 0, 0}, {2, 0, 0}, {4, 0, 0},
                                       {4, 2, 0}, {2, 1, 0}, {0, 1, 0}};
  for (int i = 0; i < 6; ++i) {
    Place place;
    place.id = PlaceId(i);
    place.T_map_place = SE3(SO3::exp({0, 0.3 * i, 0}), positions[i]);
    graph.places.push_back(place);
    if (i > 0) {
      RelativePoseConstraint edge;
      edge.from = NodeId(i - 1);
      edge.to = NodeId(i);
      graph.constraints.push_back(edge);
    }
  }
  RelativePoseConstraint loop;
  loop.from = NodeId(4);
  loop.to = NodeId(1);
  loop.source = ConstraintSource::kLoop;
  graph.constraints.push_back(loop);
  Place alone;
  alone.id = PlaceId(9);
  graph.places.push_back(alone);
  return graph;
}

std::vector<PlaceId> places_of(const Route& route) {
  std::vector<PlaceId> result;
  for (const RouteStep& step : route.steps) result.push_back(step.place);
  return result;
}

TEST(Route, TakesTheShortCutThatALoopOpens) {
  const PlaceGraph graph = places();
  const Route route = shortest_route(graph, PlaceId(0), PlaceId(5));
  ASSERT_TRUE(route.outcome);
  EXPECT_EQ(places_of(route), test::ids<PlaceId>({0, 1, 4, 5}));
  EXPECT_NEAR(route.length_m(), 2 + 1 + 2, 1e-12);
  SE3 T = graph.places[0].T_map_place;
  for (const RouteStep& step : route.steps) {
    T = T * step.T_previous_place;
    EXPECT_LT((T.inverse() * graph.find(step.place)->T_map_place).log().norm(), 1e-12);
  }
}

TEST(Route, GoesTheWayRoundWhereNoLoopIsKnown) {
  PlaceGraph graph = places();
  graph.constraints.pop_back();
  EXPECT_EQ(places_of(shortest_route(graph, PlaceId(5), PlaceId(1))),
            test::ids<PlaceId>({5, 4, 3, 2, 1}));
}

TEST(Route, LeadsBackOverTheSamePlaces) {
  const PlaceGraph graph = places();
  const Route there = shortest_route(graph, PlaceId(0), PlaceId(5)), back = backtracked(there);
  ASSERT_TRUE(back.outcome);
  EXPECT_EQ(places_of(back), test::ids<PlaceId>({5, 4, 1, 0}));
  EXPECT_NEAR(back.length_m(), there.length_m(), 1e-12);
  EXPECT_EQ(back.steps.front().leg_m, 0);
  const Route other = shortest_route(graph, PlaceId(5), PlaceId(0));
  for (std::size_t i = 0; i < back.steps.size(); ++i) {
    EXPECT_NEAR(back.steps[i].travelled_m, other.steps[i].travelled_m, 1e-12);
    EXPECT_LT(
        (back.steps[i].T_previous_place.inverse() * other.steps[i].T_previous_place).log().norm(),
        1e-12);
  }
}

TEST(Route, IsAsShortAsFloydAndWarshallHaveItBetweenAnyTwoPlaces) {
  constexpr int kPlaces = 30, kEdges = 45;
  Random random(3);
  PlaceGraph graph;
  for (int i = 0; i < kPlaces; ++i) {
    Place place;
    place.id = PlaceId(i);
    place.T_map_place = SE3(SO3(), {random.uniform(0, 9), random.uniform(0, 9), 0});
    graph.places.push_back(place);
  }
  constexpr double kNever = 1e9;
  Eigen::MatrixXd shortest = Eigen::MatrixXd::Constant(kPlaces, kPlaces, kNever);
  shortest.diagonal().setZero();
  for (int k = 0; k < kEdges; ++k) {
    RelativePoseConstraint edge;
    const int from = random.index(kPlaces), to = random.index(kPlaces);
    edge.from = NodeId(from);
    edge.to = NodeId(to);
    graph.constraints.push_back(edge);
    const double length = (graph.find(PlaceId(from))->T_map_place.translation() -
                           graph.find(PlaceId(to))->T_map_place.translation())
                              .norm();
    shortest(from, to) = shortest(to, from) = length;
  }
  for (int k = 0; k < kPlaces; ++k)
    for (int i = 0; i < kPlaces; ++i)
      for (int j = 0; j < kPlaces; ++j)
        shortest(i, j) = std::min(shortest(i, j), shortest(i, k) + shortest(k, j));
  int joined = 0;
  for (int i = 0; i < kPlaces; ++i)
    for (int j = 0; j < kPlaces; ++j) {
      const Route route = shortest_route(graph, PlaceId(i), PlaceId(j));
      ASSERT_EQ(static_cast<bool>(route.outcome), shortest(i, j) < kNever);
      if (!route.outcome) continue;
      ++joined;
      ASSERT_NEAR(route.length_m(), shortest(i, j), 1e-9);
    }
  EXPECT_GT(joined, kPlaces * kPlaces / 2);
}

TEST(Route, ToWhereItBeginsIsOnePlaceLong) {
  const Route route = shortest_route(places(), PlaceId(3), PlaceId(3));
  ASSERT_TRUE(route.outcome);
  EXPECT_EQ(places_of(route), test::ids<PlaceId>({3}));
  EXPECT_EQ(route.length_m(), 0);
}

TEST(Route, SaysThatNothingJoinsTwoPlacesAndRefusesUnknownOnes) {
  const Route route = shortest_route(places(), PlaceId(0), PlaceId(9));
  EXPECT_EQ(route.outcome.code, Outcome::Code::kDegenerate);
  EXPECT_TRUE(route.steps.empty());
  EXPECT_TRUE(backtracked(route).steps.empty());
  EXPECT_THAT(test::message_of<ArgumentError>(
                  [] { (void)shortest_route(places(), PlaceId(0), PlaceId(7)); }),
              ::testing::HasSubstr("there is no place 7; there are 0, 1"));
  EXPECT_THROW((void)shortest_route(places(), PlaceId(7), PlaceId(0)), ArgumentError);
}

}  // namespace route_test
}  // namespace placegraph
