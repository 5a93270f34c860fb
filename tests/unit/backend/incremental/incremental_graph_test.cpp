#include <gtest/gtest.h>
#include <placegraph/backend/incremental/incremental_graph.h>
#include <placegraph/backend/solver/local_solver.h>

#include "tests/support/packed_graphs.h"

namespace placegraph {
namespace incremental_graph_test {

template <class Group>
class IncrementalGraphOf : public testing::Test {
 protected:
  test::Walk<Group> walk{14, 0.05, 3};
  IncrementalGraph<Group> graph{RotationError::kLog};

  void add_all(bool poses_hold = true) {
    PositionConstraint position;
    position.node = NodeId(13);
    position.position_world = {2, 1, 0};
    walk.graph.constraints.emplace_back(position);
    for (const PoseNode& node : walk.graph.nodes) graph.add_node(node);
    graph.add_constraints(walk.graph.constraints, poses_hold);
  }
  /// The cost of the constraints that are left, by the solver's sum.
  void expect_the_cost_of_the_graph() const {
    const double cost = robust_cost(pack<Group>(graph.graph()), RotationError::kLog);
    EXPECT_NEAR(graph.cost(), cost, 1e-9 * cost);
    EXPECT_NEAR(robust_cost(graph.packed(), RotationError::kLog), cost, 1e-9 * cost);
  }
};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(IncrementalGraphOf, Groups);

TYPED_TEST(IncrementalGraphOf, IsThePackedGraphOfItsConstraints) {
  this->add_all();
  const PackedGraph<TypeParam> expected = pack<TypeParam>(this->walk.graph);
  const PackedGraph<TypeParam> packed = this->graph.packed();
  EXPECT_EQ(packed.components.held, expected.components.held);
  ASSERT_EQ(packed.edges.size(), expected.edges.size());
  for (std::size_t i = 0; i < packed.edges.size(); ++i) {
    EXPECT_EQ(packed.edges[i].from, expected.edges[i].from);
    EXPECT_EQ(packed.edges[i].to, expected.edges[i].to);
    EXPECT_EQ(packed.edges[i].constraint, expected.edges[i].constraint);
    EXPECT_EQ(packed.edges[i].T_to_from.matrix(), expected.edges[i].T_to_from.matrix());
  }
  EXPECT_EQ(this->graph.find(NodeId(13)), 3);
  EXPECT_EQ(this->graph.find(NodeId(99)), -1);
  EXPECT_EQ(this->graph.id(3), NodeId(13));
  this->expect_the_cost_of_the_graph();
}

TYPED_TEST(IncrementalGraphOf, ForgetsConstraintsOfNoWeightAndRestoresThem) {
  this->add_all();
  const double cost = this->graph.cost();
  const int count = this->graph.constraints();
  Random random(4);
  std::vector<int> removed;
  for (int c = 0; c < count; ++c)
    if (random.uniform() < 0.6) removed.push_back(c);
  test::shuffle(removed, random);
  for (const int c : removed) {
    this->graph.set_weights({{c, 0}});
    this->expect_the_cost_of_the_graph();
  }
  EXPECT_EQ(this->graph.graph().constraints.size(), count - removed.size());
  EXPECT_EQ(this->graph.constraints(), count);
  // The pieces, and what holds them, are those of the graph that is left.
  EXPECT_EQ(this->graph.packed().components.held,
            pack<TypeParam>(this->graph.graph()).components.held);
  const std::vector<int> pieces = this->graph.graph().components();
  for (int node = 0; node < 14; ++node)
    EXPECT_EQ(this->graph.together(0, node), pieces[0] == pieces[node]) << node;
  // They come back into components of their own, which then fit the first constraint.
  std::vector<TypeParam> poses;
  for (int node = 0; node < 14; ++node) poses.push_back(this->walk.pose(this->walk.graph, node));
  for (const int c : removed) this->graph.set_weights({{c, 1}});
  this->graph.set_poses(poses);
  EXPECT_NEAR(this->graph.cost(), cost, 1e-9 * cost);
  EXPECT_EQ(this->graph.packed().components.held,
            pack<TypeParam>(this->walk.graph).components.held);
}

TYPED_TEST(IncrementalGraphOf, TakesManyWeightsAsItTakesOneAfterTheOther) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    IncrementalGraph<TypeParam> together(RotationError::kLog), alone(RotationError::kLog);
    for (auto* each : {&together, &alone}) {
      for (const PoseNode& node : this->walk.graph.nodes) each->add_node(node);
      each->add_constraints(this->walk.graph.constraints, false);
    }
    Random random(seed);
    for (int round = 0; round < 4; ++round) {
      std::vector<ConstraintWeight> weights;
      for (int i = 0; i < 3 * together.constraints(); ++i)
        weights.push_back({random.index(together.constraints()), random.uniform() < 0.7 ? 0 : 2.});
      together.set_weights(weights);
      for (const ConstraintWeight& weight : weights) alone.set_weights({weight});
      EXPECT_EQ(together.packed().components.held, alone.packed().components.held);
      EXPECT_EQ(together.cost(), alone.cost());
      for (int node = 0; node < together.nodes(); ++node) {
        EXPECT_EQ(together.pose(node).matrix(), alone.pose(node).matrix());
        EXPECT_EQ(together.together(0, node), alone.together(0, node)) << node;
      }
    }
  }
}

TYPED_TEST(IncrementalGraphOf, WeighsAndRevisesConstraints) {
  this->add_all();
  for (Constraint& constraint : this->walk.graph.constraints)
    std::visit([](auto& c) { c.kernel = {RobustKernel::Kind::kCauchy, 2}; }, constraint);
  for (int c = 0; c < this->graph.constraints(); c += 2)
    this->graph.revise({c, this->walk.graph.constraints[c]});
  this->expect_the_cost_of_the_graph();
  const double before = this->graph.cost();
  for (int c = 0; c < this->graph.constraints(); ++c) this->graph.set_weights({{c, 0.25}});
  EXPECT_NEAR(this->graph.cost(), 0.25 * before, 1e-9 * before);
  this->expect_the_cost_of_the_graph();
  // A revision of a constraint without weight counts from when it has weight again.
  this->graph.set_weights({{0, 0}});
  auto other = std::get<RelativePoseConstraint>(this->graph.constraint(0));
  other.information *= 100;
  this->graph.revise({0, other});
  this->expect_the_cost_of_the_graph();
  this->graph.set_weights({{0, 1}});
  this->expect_the_cost_of_the_graph();
}

TYPED_TEST(IncrementalGraphOf, MovesByTheStepsOfTheTreeAndBack) {
  this->walk.graph.nodes[0].fixed = true;  // one measured position alone leaves rotations free
  this->add_all();
  this->graph.set_gradients();
  ASSERT_TRUE(this->graph.tree().factorize());
  const double cost = this->graph.cost(), promised = this->graph.tree().model_decrease();
  const std::vector<int> moved = this->graph.tree().solve(0);
  const PackedGraph<TypeParam> before = this->graph.packed();
  this->graph.move(moved);
  // One Gauss-Newton step of a graph this near to its minimum does much of what it promises.
  EXPECT_LT(this->graph.cost(), cost - 0.5 * promised);
  for (const int node : moved) {
    const TypeParam expected = before.poses[node].plus(this->graph.tree().delta(node));
    EXPECT_EQ(this->graph.pose(node).matrix(), expected.matrix());
  }
  this->expect_the_cost_of_the_graph();
  EXPECT_EQ(this->graph.visited().size(), before.edges.size());
  EXPECT_EQ(this->graph.relinearize(this->graph.visited(), 1e9), 0);
  EXPECT_EQ(this->graph.relinearize_all(0), static_cast<int>(before.edges.size()));
  EXPECT_EQ(this->graph.relinearize_all(1e-12), 0) << "nothing has moved since";
  this->graph.move_back(moved);
  for (int node = 0; node < 14; ++node)
    EXPECT_EQ(this->graph.pose(node).matrix(), before.poses[node].matrix());
  EXPECT_EQ(this->graph.cost(), cost);
}

TYPED_TEST(IncrementalGraphOf, PutsEveryNewPieceWhereItsFirstConstraintSays) {
  this->walk.graph.constraints.resize(13);  // a tree and some of its chords
  std::erase_if(this->walk.graph.constraints, [](const Constraint& c) {
    return std::get<RelativePoseConstraint>(c).source != ConstraintSource::kOdometry;
  });
  const std::size_t links = this->walk.graph.constraints.size();
  for (const PoseNode& node : this->walk.graph.nodes) this->graph.add_node(node);
  Random random(5);
  test::shuffle(this->walk.graph.constraints, random);
  for (const Constraint& constraint : this->walk.graph.constraints)
    this->graph.add_constraints({constraint}, false);
  // Every link joined two pieces, and none of them moved another one off.
  EXPECT_LT(this->graph.cost(), 1e-18 * static_cast<double>(links));
  EXPECT_EQ(this->graph.pose(0).matrix(), this->walk.pose(this->walk.graph, 0).matrix());
}

}  // namespace incremental_graph_test
}  // namespace placegraph
