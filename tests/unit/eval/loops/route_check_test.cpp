#include <numbers>

#include <gtest/gtest.h>
#include <placegraph/eval/loops/route_check.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {
namespace route_check_test {

constexpr double kSide_m = 40;

/// One round and a quarter of a square block, a metre a frame, the camera looking along the way;
/// the second pass is half a metre to the right.
Trajectory rounds() {
  Trajectory truth;
  for (int i = 0; i < 200; ++i) {
    const int side = i / 40 % 4;
    const SO3 heading = SO3::exp({0, side * std::numbers::pi / 2, 0});
    Eigen::Vector3d at(i < 160 ? 0 : 0.5, 0, i % 40);
    SE3 T_corner;
    for (int k = 0; k < side; ++k)
      T_corner =
          T_corner * SE3(SO3::exp({0, std::numbers::pi / 2, 0}), Eigen::Vector3d(0, 0, kSide_m));
    truth.poses.push_back({i, SE3(heading, T_corner * at).isometry()});
  }
  return truth;
}

/// A place every five metres; `loop` joins the two passes where the second begins, and one more
/// further on.
PlaceGraph map_of(const Trajectory& truth, std::map<PlaceId, FrameId>& frames, bool loops) {
  PlaceGraph graph;
  const auto edge = [&](std::int64_t from, std::int64_t to) {
    RelativePoseConstraint constraint;
    constraint.from = NodeId(from);
    constraint.to = NodeId(to);
    graph.constraints.push_back(constraint);
  };
  for (int i = 0; i < 40; ++i) {
    Place place;
    place.id = PlaceId(i);
    place.T_map_place = SE3(*truth.poses[5 * i].T_world_body);
    frames[PlaceId(i)] = FrameId(5 * i);
    graph.places.push_back(place);
    if (i > 0) edge(i - 1, i);
  }
  if (loops) edge(32, 0), edge(35, 3);
  return graph;
}

TEST(DrivenRoads, JoinThePassesOfOneRoadThatLookTheSameWay) {
  const Trajectory truth = rounds();
  const PlaceGraph roads = driven_roads(truth, {});
  int loops = 0;
  for (const RelativePoseConstraint& edge : roads.constraints) {
    if (edge.source != ConstraintSource::kLoop) continue;
    ++loops;
    EXPECT_LE(std::abs(edge.to.value() - 160 - edge.from.value()), 0)
        << edge.from << " " << edge.to;
  }
  EXPECT_EQ(loops, 40);  // every frame of the second pass; corners are of one pass
  EXPECT_EQ(roads.constraints.size(), 199u + 40u);
}

TEST(RouteCheck, FindsNothingToCriticizeInATrueMap) {
  const Trajectory truth = rounds();
  std::map<PlaceId, FrameId> frames;
  const PlaceGraph graph = map_of(truth, frames, true);
  RouteCheckOptions options;
  options.max_pairs = 2000;
  const RouteCheck check = check_routes(graph, frames, truth, options);
  EXPECT_EQ(check.pairs, 40 * 39 / 2);
  EXPECT_EQ(check.same_places, check.pairs);
  EXPECT_EQ(check.apart, 0);
  EXPECT_NEAR(check.worst_excess, 0, 1e-12);
  EXPECT_NEAR(check.worst_length_error, 0, 1e-12);
  // The last place is 20 m beyond the last loop: there and back to the first pass beside it.
  EXPECT_NEAR(check.worst_detour_m, 40, 1);
  EXPECT_GT(check.within_5_percent, 0.8 * check.pairs);
}

TEST(RouteCheck, FindsAMapWithoutLoopsToMissWhereRoadsMeet) {
  const Trajectory truth = rounds();
  std::map<PlaceId, FrameId> frames;
  const RouteCheck check = check_routes(map_of(truth, frames, false), frames, truth);
  EXPECT_EQ(check.same_places, check.pairs);  // of the roads that it has
  EXPECT_GT(check.worst_detour_m, 150);       // from one pass to the other: all the way round
}

TEST(RouteCheck, FindsAFalseLoopToLeadAstray) {
  const Trajectory truth = rounds();
  std::map<PlaceId, FrameId> frames;
  PlaceGraph graph = map_of(truth, frames, true);
  // The map believes that the place across the block is beside the first.
  graph.places[16].T_map_place = SE3(SO3(), Eigen::Vector3d(1, 0, 0));
  RelativePoseConstraint wrong;
  wrong.from = NodeId(0);
  wrong.to = NodeId(16);
  graph.constraints.push_back(wrong);
  const RouteCheck check = check_routes(graph, frames, truth);
  EXPECT_LT(check.same_places, check.pairs);
  EXPECT_GT(check.worst_excess, 0.1);
  EXPECT_GT(check.worst_length_error, 0.5);
}

TEST(RouteCheck, CountsPairsThatNothingJoinsAndRefusesPlacesWithoutTruth) {
  Trajectory truth = rounds();
  std::map<PlaceId, FrameId> frames;
  PlaceGraph graph = map_of(truth, frames, false);
  graph.constraints.erase(graph.constraints.begin() + 19);  // between places 19 and 20
  RouteCheckOptions options;
  options.max_pairs = 2000;
  const RouteCheck check = check_routes(graph, frames, truth, options);
  EXPECT_EQ(check.apart, 400);
  EXPECT_EQ(check.pairs, 380);
  truth.poses[25].T_world_body.reset();
  EXPECT_THROW((void)check_routes(graph, frames, truth), ArgumentError);
  options.same.heading_deg = 200;
  EXPECT_THROW((void)driven_roads(truth, options), ArgumentError);
}

}  // namespace route_check_test
}  // namespace placegraph
