#include <gtest/gtest.h>
#include <placegraph/backend/solver/normal_equations.h>
#include <placegraph/backend/solver/packed_graph.h>

#include <Eigen/LU>

#include "tests/support/packed_graphs.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace packed_graph_test {

PositionConstraint position_of_node(std::int64_t node, const Eigen::Vector3d& position_world) {
  PositionConstraint position;
  position.node = NodeId(node);
  position.position_world = position_world;
  return position;
}

template <class Group>
class PackedGraphOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(PackedGraphOf, Groups);

TYPED_TEST(PackedGraphOf, KeepsTheOrderOfNodesAndConstraints) {
  test::Walk<TypeParam> walk(12, 0.1);
  Random random(2);
  for (int i = 0; i < 4; ++i)
    walk.graph.constraints.emplace_back(position_of_node(10 + 2 * i, {1.0 * i, 2, 3}));
  test::shuffle(walk.graph.nodes, random);
  test::shuffle(walk.graph.constraints, random);
  const PackedGraph<TypeParam> packed = pack<TypeParam>(walk.graph);
  ASSERT_EQ(packed.poses.size(), walk.graph.nodes.size());
  for (std::size_t i = 0; i < packed.poses.size(); ++i)
    EXPECT_EQ(packed.poses[i].matrix(), walk.pose(walk.graph, static_cast<int>(i)).matrix());
  const auto id = [&](int node) { return walk.graph.nodes[node].id; };
  std::size_t edges = 0, positions = 0;
  for (std::size_t c = 0; c < walk.graph.constraints.size(); ++c) {
    const Constraint& constraint = walk.graph.constraints[c];
    if (const auto* measured = std::get_if<RelativePoseConstraint>(&constraint)) {
      const auto& edge = packed.edges.at(edges++);
      EXPECT_EQ(edge.constraint, static_cast<int>(c));
      EXPECT_EQ(id(edge.from), measured->from);
      EXPECT_EQ(id(edge.to), measured->to);
      EXPECT_EQ(edge.odometry, measured->source == ConstraintSource::kOdometry);
      EXPECT_EQ(edge.weight, 1);
      const TypeParam back_and_forth = edge.T_to_from * std::get<TypeParam>(measured->T_from_to);
      EXPECT_LT(back_and_forth.log().norm(), 1e-12);
    } else {
      const auto& position = packed.positions.at(positions++);
      EXPECT_EQ(position.constraint, static_cast<int>(c));
      EXPECT_EQ(id(position.node), std::get<PositionConstraint>(constraint).node);
      EXPECT_EQ(position.position_world, std::get<PositionConstraint>(constraint).position_world);
    }
  }
  EXPECT_EQ(edges, packed.edges.size());
  EXPECT_EQ(positions, packed.positions.size());
}

TYPED_TEST(PackedGraphOf, WritesBackTheNodesThatAreNotHeldAlone) {
  test::Walk<TypeParam> walk(10, 0.1);
  walk.graph.nodes[3].fixed = walk.graph.nodes[7].fixed = true;
  PackedGraph<TypeParam> packed = pack<TypeParam>(walk.graph);
  Random random(3);
  for (TypeParam& pose : packed.poses)
    pose = pose * test::random_element<TypeParam>(random, 0.1, 0.1);
  PoseGraph graph = walk.graph;
  unpack(packed, graph);
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(walk.pose(graph, i).matrix(),
              (i == 3 || i == 7 ? walk.pose(walk.graph, i) : packed.poses[i]).matrix());
}

TEST(PackedGraph, HoldsTheFirstNodeOfEveryPieceThatNothingAnchors) {
  Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    PoseGraph graph;
    const int n = 1 + random.index(12);
    for (int i = 0; i < n; ++i)
      graph.nodes.push_back({NodeId(100 - 3 * i), SE2(), random.uniform() < 0.1});
    for (int k = random.index(n + 1); n > 1 && k > 0; --k) {
      const int from = random.index(n), to = (from + 1 + random.index(n - 1)) % n;
      graph.constraints.emplace_back(
          test::constraint<SE2>(100 - 3 * from, 100 - 3 * to, SE2(1, 2, 3)));
    }
    if (random.uniform() < 0.5)
      graph.constraints.emplace_back(position_of_node(100 - 3 * random.index(n), {1, 2, 0}));
    const PackedGraph<SE2> packed = pack<SE2>(graph);
    const std::vector<int> piece = graph.components();
    for (int i = 0; i < n; ++i) {
      bool anchored = false, first = true;
      for (int j = 0; j < n; ++j) {
        if (piece[j] != piece[i]) continue;
        anchored |= graph.nodes[j].fixed;
        first &= j >= i;
        for (const auto& position : packed.positions) anchored |= position.node == j;
      }
      EXPECT_EQ(packed.components.held[i] != 0, graph.nodes[i].fixed || (!anchored && first))
          << "trial " << trial << " node " << i;
    }
  }
}

/// The rank of the normal equations of the nodes that are not held.
Eigen::Index rank_of(const PackedGraph<SE2>& packed) {
  NormalEquations<SE2> equations(packed);
  equations.linearize(packed, RotationError::kLog);
  const Eigen::Index size = 3 * static_cast<Eigen::Index>(equations.block_count());
  Eigen::MatrixXd H(size, size);
  Eigen::VectorXd column;
  for (Eigen::Index i = 0; i < size; ++i) {
    equations.matrix().multiply(Eigen::VectorXd::Unit(size, i), column);
    H.col(i) = column;
  }
  return size == 0 ? 0 : Eigen::FullPivLU<Eigen::MatrixXd>(H).setThreshold(1e-9).rank();
}

TEST(PackedGraph, CountsTheDegreesOfFreedomOfItsErrors) {
  Random random = test::seeded_random(8);
  for (int trial = 0; trial < 200; ++trial) {
    PoseGraph graph;
    const int n = 1 + random.index(12);
    for (int i = 0; i < n; ++i)
      graph.nodes.push_back({NodeId(i), test::random_element<SE2>(random, 3, 1),
                             random.uniform() < 0.2});
    for (int k = random.index(2 * n); n > 1 && k > 0; --k) {
      const int from = random.index(n), to = (from + 1 + random.index(n - 1)) % n;
      graph.constraints.emplace_back(
          test::constraint<SE2>(from, to, test::random_element<SE2>(random, 3, 1)));
    }
    for (int i = 0; i < n; ++i)
      if (random.uniform() < 0.2)
        graph.constraints.emplace_back(
            position_of_node(i, {random.normal(), random.normal(), 0}));
    const PackedGraph<SE2> packed = pack<SE2>(graph);
    const auto errors = static_cast<Eigen::Index>(3 * packed.edges.size() +
                                                  2 * packed.positions.size());
    EXPECT_EQ(packed.components.degrees_of_freedom, errors - rank_of(packed)) << "trial " << trial;
    EXPECT_GE(packed.components.redundant, 0);
    if (!packed.positions.empty()) continue;
    EXPECT_EQ(packed.components.degrees_of_freedom, 3 * packed.components.redundant);
  }
}

template <class Group>
class PackedLandmarkGraph : public testing::Test {
 protected:
  /// Two nodes without a constraint between them; both see the point 31, the second 30 too.
  static LandmarkGraph graph() {
    LandmarkGraph graph;
    Random random(5);
    for (const int id : {7, 3})
      graph.poses.nodes.push_back({NodeId(id), test::random_element<Group>(random, 2, 1), false});
    graph.points = {{NodeId(30), {1, 2, 0}}, {NodeId(31), {3, 4, 0}}};
    graph.observations = {{NodeId(3), NodeId(31), {1, 1, 0}},
                          {NodeId(7), NodeId(31), {2, 2, 0}},
                          {NodeId(3), NodeId(30), {3, 3, 0}}};
    return graph;
  }
};
using RigidGroups = testing::Types<SE2, SE3>;
TYPED_TEST_SUITE(PackedLandmarkGraph, RigidGroups);

TYPED_TEST(PackedLandmarkGraph, PutsThePointsBehindTheNodesAndTheWorldLast) {
  const LandmarkGraph graph = TestFixture::graph();
  const PackedGraph<TypeParam> packed = pack<TypeParam>(graph);
  ASSERT_EQ(packed.poses.size(), 5u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(point_of(packed.poses[2 + i]), graph.points[i].position_world);
    EXPECT_EQ(packed.poses[2 + i].rotation().log().norm(), 0);
  }
  EXPECT_EQ(packed.poses[4].log().norm(), 0);
  const int nodes[] = {1, 0, 1}, points[] = {3, 3, 2};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(packed.observations[i].node, nodes[i]);
    EXPECT_EQ(packed.observations[i].point, points[i]);
    EXPECT_EQ(packed.observations[i].p_node, graph.observations[i].position_node);
  }
}

TYPED_TEST(PackedLandmarkGraph, IsOnePieceByTheObservations) {
  LandmarkGraph graph = TestFixture::graph();
  EXPECT_EQ(pack<TypeParam>(graph).components.held, (std::vector<char>{1, 0, 0, 0, 1}));
  graph.points[0].fixed = true;
  EXPECT_EQ(pack<TypeParam>(graph).components.held, (std::vector<char>{0, 0, 1, 0, 1}));
  graph.points[0].fixed = false;
  graph.observations.erase(graph.observations.begin() + 1);
  EXPECT_EQ(pack<TypeParam>(graph).components.held, (std::vector<char>{1, 1, 0, 0, 1}));
}

TYPED_TEST(PackedLandmarkGraph, MeasuresAPoseFromTheHeldWorld) {
  LandmarkGraph graph = TestFixture::graph();
  Random random(6);
  const auto measured = test::random_element<TypeParam>(random, 2, 1);
  graph.priors.push_back({NodeId(3), measured, test::isotropic<TypeParam>(4)});
  const PackedGraph<TypeParam> packed = pack<TypeParam>(graph);
  ASSERT_EQ(packed.edges.size(), 1u);
  const auto& edge = packed.edges[0];
  EXPECT_EQ(edge.constraint, -1);
  EXPECT_FALSE(edge.odometry);
  EXPECT_EQ(edge.from, 4);
  EXPECT_EQ(edge.to, 1);
  EXPECT_LT((edge.T_to_from * measured).log().norm(), 1e-12);
  // The measured pose anchors all that is connected to it.
  EXPECT_EQ(packed.components.held, (std::vector<char>{0, 0, 0, 0, 1}));
}

}  // namespace packed_graph_test
}  // namespace placegraph
