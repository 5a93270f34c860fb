#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/place_graph.h>

#include <vector>

namespace placegraph {
namespace place_graph_test {

using testing::ElementsAre;

PlaceGraph make_places(const std::vector<int>& components) {
  PlaceGraph graph;
  for (std::size_t i = 0; i < components.size(); ++i) {
    Place place;
    place.id = PlaceId(10 * static_cast<std::int64_t>(i + 1));
    place.component = components[i];
    place.T_map_place = SE3(SO3(), Eigen::Vector3d(static_cast<double>(i), 0, 0));
    graph.places.push_back(place);
  }
  return graph;
}

void join(PlaceGraph& graph, std::int64_t from, std::int64_t to) {
  RelativePoseConstraint constraint;
  constraint.from = NodeId(from);
  constraint.to = NodeId(to);
  constraint.T_from_to = SE3();
  constraint.information = Matrix6d::Identity();
  graph.constraints.push_back(constraint);
}

std::vector<bool> fixed(const PlaceGraph& graph) {
  std::vector<bool> result;
  for (const PoseNode& node : graph.pose_graph().nodes) result.push_back(node.fixed);
  return result;
}

TEST(PlaceGraph, FindsPlacesByIdWhateverTheirOrder) {
  PlaceGraph graph = make_places({0, 0});
  EXPECT_EQ(graph.find(PlaceId(20)), &graph.places[1]);
  EXPECT_EQ(graph.find(PlaceId(1)), nullptr);
  graph.places[0].id = PlaceId(1);
  graph.places[1].id = PlaceId(0);
  EXPECT_EQ(graph.find(PlaceId(0)), &graph.places[1]);
}

TEST(PlaceGraph, JoinsPlacesOfOneComponentAndPlacesWithAConstraint) {
  PlaceGraph graph = make_places({0, 0, 1, 2, 1});
  EXPECT_THAT(graph.joined_components(), ElementsAre(0, 0, 1, 2, 1));
  join(graph, 50, 20);
  EXPECT_THAT(graph.joined_components(), ElementsAre(0, 0, 0, 2, 0));
}

TEST(PlaceGraph, RefusesAConstraintOnAnUnknownPlace) {
  PlaceGraph graph = make_places({0});
  join(graph, 10, 11);
  EXPECT_THROW(graph.joined_components(), ArgumentError);
}

TEST(PlaceGraph, PoseGraphFixesTheFirstPlaceOfEveryJoinedComponent) {
  PlaceGraph graph = make_places({0, 0, 1, 1, 2});
  EXPECT_THAT(fixed(graph), ElementsAre(true, false, true, false, true));
  join(graph, 40, 10);
  EXPECT_THAT(fixed(graph), ElementsAre(true, false, false, false, true));
  EXPECT_NO_THROW(graph.pose_graph().check());
  EXPECT_EQ(graph.pose_graph().constraints.size(), 1u);
}

TEST(PlaceGraph, TakesOverOptimizedPosesById) {
  PlaceGraph graph = make_places({0, 0});
  PoseGraph optimized = graph.pose_graph();
  optimized.nodes[1].T_world_node = SE3(SO3::exp({0, 0, 1}), {5, 6, 7});
  std::swap(optimized.nodes[0], optimized.nodes[1]);
  graph.set_poses(optimized);
  EXPECT_EQ(graph.places[0].T_map_place.translation(), Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(graph.places[1].T_map_place.translation(), Eigen::Vector3d(5, 6, 7));
}

TEST(PlaceGraph, RefusesPosesThatAreNotItsOwn) {
  PlaceGraph graph = make_places({0, 0});
  PoseGraph lacking = graph.pose_graph();
  lacking.nodes.pop_back();
  EXPECT_THROW(graph.set_poses(lacking), ArgumentError);
  PoseGraph planar = graph.pose_graph();
  for (PoseNode& node : planar.nodes) node.T_world_node = SE2();
  EXPECT_THROW(graph.set_poses(planar), ArgumentError);
}

TEST(PlaceGraph, IsOneOfSimilaritiesIfItsConstraintsAre) {
  PlaceGraph graph = make_places({0, 0});
  graph.places[1].scale = 3;
  join(graph, 10, 20);
  graph.constraints[0].T_from_to = Sim3(SO3(), {1, 0, 0}, 2);
  graph.constraints[0].information = Matrix7d::Identity();
  PoseGraph optimized = graph.pose_graph();
  EXPECT_NO_THROW(optimized.check());
  EXPECT_EQ(std::get<Sim3>(optimized.nodes[1].T_world_node).scale(), 3);
  optimized.nodes[1].T_world_node = Sim3(SO3(), {5, 6, 7}, 2.5);
  graph.set_poses(optimized);
  EXPECT_EQ(graph.places[1].T_map_place.translation(), Eigen::Vector3d(5, 6, 7));
  EXPECT_EQ(graph.places[1].scale, 2.5);
}

}  // namespace place_graph_test
}  // namespace placegraph
