#include <gtest/gtest.h>
#include <placegraph/backend/initialization/held_nodes.h>

#include "tests/support/scenes/pose_walk.h"

namespace placegraph {
namespace held_nodes_test {

using test::Walk;

template <class Group>
class HeldNodeConstraintsOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(HeldNodeConstraintsOf, Groups);

TYPED_TEST(HeldNodeConstraintsOf, TiesTheHeldNodesOfAComponentAsTheyStand) {
  constexpr int dim = kSpaceDim<TypeParam>;
  const Walk<TypeParam> walk(12, 0.1);
  PoseGraph fixed = walk.graph;
  for (const int i : {2, 5, 9}) fixed.nodes[i].fixed = true;
  const PackedGraph<TypeParam> graph = pack<TypeParam>(fixed);
  const auto problem = held_node_constraints(graph, RotationError::kLog);
  const std::size_t edges = graph.edges.size();
  ASSERT_EQ(problem.edges.size(), edges + 2);
  double heaviest_rotation = 0, heaviest_translation = 0;
  for (std::size_t i = 0; i < edges; ++i) {
    heaviest_rotation = std::max(heaviest_rotation, problem.edges[i].rotation_weight);
    heaviest_translation = std::max(heaviest_translation, problem.edges[i].translation_weight);
  }
  const int from[] = {2, 5}, to[] = {5, 9};
  for (int k = 0; k < 2; ++k) {
    const auto& tie = problem.edges[edges + k];
    EXPECT_EQ(tie.from, from[k]);
    EXPECT_EQ(tie.to, to[k]);
    EXPECT_DOUBLE_EQ(tie.rotation_weight, 1e3 * heaviest_rotation);
    EXPECT_DOUBLE_EQ(tie.translation_weight, 1e3 * heaviest_translation);
    const TypeParam &a = graph.poses[from[k]], &b = graph.poses[to[k]];
    EXPECT_LT((a.rotation().matrix() * tie.R - b.rotation().matrix()).norm(), 1e-12);
    EXPECT_LT((a.rotation() * typename IsotropicProblem<dim>::Vector(tie.t) + a.translation() -
               b.translation())
                  .norm(),
              1e-12);
  }
}

TYPED_TEST(HeldNodeConstraintsOf, TiesCostNothingAtTheHeldPoses) {
  const Walk<TypeParam> walk(12, 0.1);
  PoseGraph fixed = walk.graph;
  for (const int i : {0, 4, 7}) fixed.nodes[i].fixed = true;
  const PackedGraph<TypeParam> graph = pack<TypeParam>(fixed);
  auto problem = held_node_constraints(graph, RotationError::kLog);
  const double constrained = isotropic_cost(problem, graph.poses);
  problem.edges.resize(graph.edges.size());
  EXPECT_NEAR(constrained, isotropic_cost(problem, graph.poses), 1e-9 * constrained);
}

TYPED_TEST(HeldNodeConstraintsOf, TiesNothingAcrossComponentsNorWhereOneNodeIsHeld) {
  PoseGraph two = Walk<TypeParam>(6, 0.1).graph;
  const PoseGraph other = Walk<TypeParam>(6, 0.1, 2).graph;
  for (PoseNode node : other.nodes) {
    node.id = NodeId(node.id.value() + 100);
    two.nodes.push_back(node);
  }
  for (const Constraint& c : other.constraints) {
    auto moved = std::get<RelativePoseConstraint>(c);
    moved.from = NodeId(moved.from.value() + 100);
    moved.to = NodeId(moved.to.value() + 100);
    two.constraints.emplace_back(moved);
  }
  two.nodes[1].fixed = two.nodes[8].fixed = true;
  const PackedGraph<TypeParam> graph = pack<TypeParam>(two);
  EXPECT_EQ(held_node_constraints(graph, RotationError::kLog).edges.size(),
            graph.edges.size());
}

}  // namespace held_nodes_test
}  // namespace placegraph
