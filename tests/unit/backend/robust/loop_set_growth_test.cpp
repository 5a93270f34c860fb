#include <gtest/gtest.h>
#include <placegraph/backend/robust/loop_set_growth.h>

#include "tests/support/packed_graphs.h"
#include "tests/support/scenes/looped_walk.h"

namespace placegraph {
namespace loop_set_growth_test {

template <class Group>
class LoopSetGrowthOf : public testing::Test {
 protected:
  test::LoopedWalk<Group> walk{{.nodes = 100,
                                .lap = 25,
                                .noise = 0.02,
                                .claimed = 0.1,
                                .false_loops = 20,
                                .cluster = 4,
                                .seed = 2}};
  PackedGraph<Group> graph = pack<Group>(walk.graph);

  bool is_true(const typename PackedGraph<Group>::Edge& edge) const {
    return edge.constraint < static_cast<int>(walk.true_constraints);
  }
  LoopSupport support() const { return support_loops(graph, OdometryChain<Group>(graph), {}); }
  void expect_the_true_loops() const {
    for (const auto& edge : graph.edges)
      EXPECT_EQ(edge.weight, is_true(edge) ? 1 : 0) << "constraint " << edge.constraint;
  }
};
using Groups = testing::Types<SE2, SE3>;
TYPED_TEST_SUITE(LoopSetGrowthOf, Groups);

TYPED_TEST(LoopSetGrowthOf, FindsTheTrueLoopsAndTheNoise) {
  const LoopSetGrowth growth = extend_loop_set(this->graph, this->support(), 0.999, {}, {}, {});
  EXPECT_TRUE(growth.local.outcome) << growth.local.outcome.reason;
  this->expect_the_true_loops();
  // The information claims five times the deviation; loops share nodes, so their mean is rough.
  EXPECT_GT(growth.noise_scale, 0.5 / 25);
  EXPECT_LT(growth.noise_scale, 2.0 / 25);
  EXPECT_NEAR(growth.local.cost_final, robust_cost(this->graph, RotationError::kLog),
              1e-9 * growth.local.cost_final);
}

TYPED_TEST(LoopSetGrowthOf, SettlesFromPosesThatAreNearlyRight) {
  const LoopSupport support = this->support();
  this->graph.poses = this->walk.truth;
  for (auto& edge : this->graph.edges)
    if (!edge.odometry) edge.weight = edge.constraint % 2;  // true and false ones
  for (auto& edge : this->graph.edges)
    if (!this->is_true(edge)) edge.weight = 0;
  (void)settle_loops(this->graph, support, 0.999, {}, {}, {});
  this->expect_the_true_loops();
}

TYPED_TEST(LoopSetGrowthOf, KeepsTheBestLoopThatAloneConnectsAPart) {
  // Odometry is missing after node 98: loops alone reach the last node, all but one far off.
  std::erase_if(this->graph.edges, [](const auto& edge) { return edge.to == 99; });
  auto bridge = this->graph.edges[40];
  bridge.odometry = false;
  bridge.from = 60;
  bridge.to = 99;
  for (const double off : {0.0, 3.0}) {
    typename TypeParam::Tangent xi = TypeParam::Tangent::Zero();
    xi[0] = off;
    bridge.T_to_from = TypeParam::exp(xi) * this->graph.poses[99].inverse() * this->graph.poses[60];
    this->graph.edges.push_back(bridge);
  }
  (void)extend_loop_set(this->graph, this->support(), 0.999, {}, {}, {});
  const std::size_t last = this->graph.edges.size() - 1;
  EXPECT_EQ(this->graph.edges[last - 1].weight, 1);
  EXPECT_EQ(this->graph.edges[last].weight, 0);
}

}  // namespace loop_set_growth_test
}  // namespace placegraph
