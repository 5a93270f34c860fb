#include <gtest/gtest.h>
#include <placegraph/backend/solver/packed_free_directions.h>

#include <numeric>

#include "tests/support/message_of.h"
#include "tests/support/packed_graphs.h"

namespace placegraph {
namespace free_directions_test {

/// Nodes from `first` to `last`.
std::vector<int> range(int first, int last) {
  std::vector<int> nodes(static_cast<std::size_t>(last - first + 1));
  std::iota(nodes.begin(), nodes.end(), first);
  return nodes;
}

/// The number of free directions for each number of measured positions on no common line.
template <class Group>
constexpr int kFreeWithPositions[] = {0, Group::kDof - 3, 1, 0};
template <>
constexpr int kFreeWithPositions<SE2>[] = {0, 1, 0, 0};

template <class Group>
class FreeDirectionsOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(FreeDirectionsOf, Groups);

TYPED_TEST(FreeDirectionsOf, AreThoseThatMeasuredPositionsLeave) {
  for (int positions = 0; positions <= 3; ++positions) {
    test::Walk<TypeParam> walk(9, 0);
    for (int i = 0; i < 9; ++i) walk.graph.nodes[i].T_world_node = walk.truth[i];
    for (int i = 0; i < positions; ++i) {
      PositionConstraint position;
      position.node = NodeId(10 + 3 * i);
      constexpr int dim = TypeParam::kDof == 3 ? 2 : 3;
      position.position_world.template head<dim>() = walk.truth[3 * i].translation();
      walk.graph.constraints.emplace_back(position);
    }
    const FreeDirections free = find_free_directions(walk.graph, RotationError::kLog);
    EXPECT_EQ(free.count, kFreeWithPositions<TypeParam>[positions]) << positions << " positions";
    if (free.count > 0) {
      EXPECT_EQ(free.nodes.size(), 9u);
    } else {
      EXPECT_TRUE(free.nodes.empty());
    }
  }
}

TYPED_TEST(FreeDirectionsOf, OfALinkWithoutSomeInformationMoveAllBehindIt) {
  Random random(1);
  for (const double scale : {1e-6, 1.0, 1e6})
    for (int lacking = 0; lacking < TypeParam::kDof; ++lacking) {
      PackedGraph<TypeParam> graph = test::packed_walk<TypeParam>(8, 0, 2);
      graph.edges.resize(0);
      for (int i = 1; i < 8; ++i) {
        typename TypeParam::Jacobian information =
            test::random_information<typename TypeParam::Jacobian>(random);
        const TypeParam T_from_to = graph.poses[i - 1].inverse() * graph.poses[i];
        if (i == 5) information.topRows(lacking).setZero(), information.leftCols(lacking).setZero();
        graph.edges.push_back({i - 1, i, 0, true, T_from_to.inverse(), scale * information, {}});
      }
      const FreeDirections free = find_free_directions(graph, RotationError::kLog);
      EXPECT_EQ(free.count, lacking) << "scale " << scale;
      EXPECT_EQ(free.nodes, lacking ? range(5, 7) : std::vector<int>()) << "scale " << scale;
    }
}

TYPED_TEST(FreeDirectionsOf, OfAPartWithoutWeightAreAllOfItsMotion) {
  PackedGraph<TypeParam> graph = test::packed_walk<TypeParam>(9, 0, 3);
  for (auto& edge : graph.edges)
    if ((edge.from < 6) != (edge.to < 6)) edge.weight = 0;
  const FreeDirections free = find_free_directions(graph, RotationError::kQuaternion);
  EXPECT_EQ(free.count, TypeParam::kDof);
  EXPECT_EQ(free.nodes, range(6, 8));
}

/// Nodes around a held one; of the links to it only the translation is measured.
PackedGraph<SE3> star(int nodes) {
  PackedGraph<SE3> graph;
  graph.poses.resize(static_cast<std::size_t>(nodes) + 1);
  graph.components.held.assign(graph.poses.size(), false);
  graph.components.held[0] = true;
  Matrix6d information = Matrix6d::Zero();
  information.diagonal().head<3>().setConstant(9);
  for (int i = 1; i <= nodes; ++i) graph.edges.push_back({0, i, 0, true, SE3(), information, {}});
  return graph;
}

TEST(FreeDirections, AreCountedUpToALimit) {
  EXPECT_EQ(find_free_directions(star(3), RotationError::kLog).count, 9);
  EXPECT_EQ(find_free_directions(star(20), RotationError::kLog).count, 60);
  EXPECT_EQ(find_free_directions(star(30), RotationError::kLog).count, FreeDirections::kMost);
}

TEST(FreeDirections, OfALandmarkGraphNumberThePointsBehindTheNodes) {
  LandmarkGraph graph;
  graph.poses.nodes = {{NodeId(4), SE3(), true}};
  graph.points = {{NodeId(8), {1, 2, 3}}, {NodeId(9), {3, 2, 5}}};
  graph.observations = {{NodeId(4), NodeId(8), {1, 2, 3}}, {NodeId(4), NodeId(9), {3, 2, 5}}};
  EXPECT_EQ(find_free_directions(graph, RotationError::kLog).count, 0);
  // A camera that sees the second point, but not how far it is.
  const Eigen::Vector3d ray = Eigen::Vector3d(3, 2, 5).normalized();
  graph.observations[1].information = Eigen::Matrix3d::Identity() - ray * ray.transpose();
  const FreeDirections free = find_free_directions(graph, RotationError::kLog);
  EXPECT_EQ(free.count, 1);
  EXPECT_EQ(free.nodes, std::vector<int>{2});
}

TEST(FreeDirections, OfNothingOrOfHeldNodesAreNone) {
  EXPECT_EQ(find_free_directions(PoseGraph(), RotationError::kLog).count, 0);
  PoseGraph graph;
  graph.nodes = {{NodeId(1), SE2(), true}, {NodeId(2), SE2(), true}};
  graph.constraints = {test::constraint<SE2>(1, 2, SE2(1, 0, 0))};
  EXPECT_EQ(find_free_directions(graph, RotationError::kLog).count, 0);
}

TEST(FreeDirections, OfABrokenGraphAreAnError) {
  PoseGraph graph;
  graph.nodes = {{NodeId(1), SE2(), false}};
  graph.constraints = {test::constraint<SE2>(1, 77, SE2(1, 0, 0))};
  const std::string message = test::message_of<ArgumentError>(
      [&] { (void)find_free_directions(graph, RotationError::kLog); });
  EXPECT_NE(message.find("unknown node 77"), std::string::npos) << message;
}

}  // namespace free_directions_test
}  // namespace placegraph
