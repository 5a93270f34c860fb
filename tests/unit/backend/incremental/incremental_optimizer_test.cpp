#include <gtest/gtest.h>
#include <placegraph/backend/incremental/incremental_replay.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/backend/pose_graph/pose_marginals.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>

#include "tests/support/scenes/incremental_walk.h"

namespace placegraph {
namespace incremental_optimizer_test {

using test::IncrementalWalk;

PoseGraphOptions tight() {
  PoseGraphOptions options;
  options.relative_decrease = 1e-15;
  return options;
}

template <class Group>
class IncrementalOptimizerOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(IncrementalOptimizerOf, Groups);

TYPED_TEST(IncrementalOptimizerOf, ReplayEndsAtTheOptimumOfTheWholeGraph) {
  const IncrementalWalk<TypeParam> walk(60, 0.03, 1);
  const IncrementalReplay replay = optimize_incrementally(walk.graph);
  EXPECT_TRUE(replay.outcome) << replay.outcome.reason;
  const PoseGraphReport batch = optimize_pose_graph(replay.graph, tight());
  EXPECT_NEAR(replay.cost, batch.chi2_final, 1e-6 * batch.chi2_final);
  EXPECT_NEAR(chi2(replay.graph, RotationError::kLog), replay.cost, 1e-9 * replay.cost);
  EXPECT_EQ(replay.step_cpu_ms.size(), walk.graph.nodes.size());
  EXPECT_GE(replay.step_cpu_ms_max, replay.step_cpu_ms_p95);
  EXPECT_GT(replay.step_cpu_ms_mean, 0);
}

/// Feeds the walk node by node; `after` is called after every step.
template <class Group, class After>
void feed(IncrementalOptimizer& optimizer, const PoseGraph& graph, bool reversed, After&& after) {
  for (const PoseNode& node : graph.nodes) {
    std::vector<Constraint> constraints;
    for (const Constraint& c : graph.constraints)
      if (std::get<RelativePoseConstraint>(c).to == node.id) constraints.push_back(c);
    if (reversed) std::reverse(constraints.begin(), constraints.end());
    after(optimizer.add({node}, constraints));
  }
}

TYPED_TEST(IncrementalOptimizerOf, EveryStepStaysWithinTheExcessAskedFor) {
  const IncrementalWalk<TypeParam> walk(40, 0.03, 2);
  IncrementalOptions options;
  options.excess = 1e-4;
  IncrementalOptimizer optimizer(options);
  feed<TypeParam>(optimizer, walk.graph, false, [&](const IncrementalStep& step) {
    const double best = optimize_pose_graph(optimizer.graph(), tight()).chi2_final;
    // The prediction is that of a quadratic model: twice as much is granted.
    EXPECT_LE(step.cost, best * (1 + 2e-4) + 1e-9);
    EXPECT_NEAR(step.cost, chi2(optimizer.graph(), RotationError::kLog), 1e-9 * (1 + step.cost));
  });
}

TYPED_TEST(IncrementalOptimizerOf, TheOrderOfConstraintsOfAStepChangesNothing) {
  const IncrementalWalk<TypeParam> walk(40, 0.03, 3);
  IncrementalOptimizer a, b;
  feed<TypeParam>(a, walk.graph, false, [](const IncrementalStep&) {});
  feed<TypeParam>(b, walk.graph, true, [](const IncrementalStep&) {});
  a.finish();
  b.finish();
  EXPECT_NEAR(a.cost(), b.cost(), 1e-7 * a.cost());
}

TYPED_TEST(IncrementalOptimizerOf, ARemovedConstraintIsAsIfItHadNeverBeen) {
  IncrementalWalk<TypeParam> walk(40, 0.03, 4);
  IncrementalOptimizer optimizer;
  feed<TypeParam>(optimizer, walk.graph, false, [](const IncrementalStep&) {});
  RelativePoseConstraint wrong = walk.measure(3, 30, 0);
  wrong.T_from_to = TypeParam();
  wrong.source = ConstraintSource::kLoop;
  const IncrementalStep step = optimizer.add({}, {wrong});
  EXPECT_EQ(step.first_constraint, static_cast<int>(walk.graph.constraints.size()));
  EXPECT_EQ(optimizer.graph().constraints.size(), walk.graph.constraints.size() + 1);
  optimizer.remove_constraint(step.first_constraint);
  optimizer.finish();
  EXPECT_EQ(optimizer.graph().constraints.size(), walk.graph.constraints.size());
  const double best = optimize_pose_graph(optimizer.graph(), tight()).chi2_final;
  EXPECT_NEAR(optimizer.cost(), best, 1e-6 * best);
}

TYPED_TEST(IncrementalOptimizerOf, PiecesAreJoinedLaterAndFallApartAgain) {
  IncrementalWalk<TypeParam> walk(30, 0, 5);
  IncrementalOptimizer optimizer;
  // Two halves of a chain, the second somewhere else; then the link between them.
  for (int i = 0; i < 30; ++i) {
    std::vector<Constraint> link;
    if (i != 0 && i != 15) link.emplace_back(walk.measure(i - 1, i, 0));
    optimizer.add({walk.graph.nodes[i]}, link);
  }
  const auto relative = [&](int i, int j) {
    return std::get<TypeParam>(*optimizer.pose(NodeId(10 + i))).inverse() *
           std::get<TypeParam>(*optimizer.pose(NodeId(10 + j)));
  };
  const auto error = [&](int i, int j) {
    return (relative(i, j).inverse() * walk.truth[i].inverse() * walk.truth[j]).log().norm();
  };
  EXPECT_LT(error(15, 29), 1e-9);
  EXPECT_GT(error(0, 29), 0.1);
  const int joint = optimizer.add({}, {walk.measure(14, 15, 0)}).first_constraint;
  EXPECT_LT(error(0, 29), 1e-9);
  EXPECT_LT(optimizer.cost(), 1e-12);
  optimizer.remove_constraint(joint);
  optimizer.add({}, {walk.measure(2, 17, 0)});
  EXPECT_LT(error(0, 29), 1e-9);
}

TYPED_TEST(IncrementalOptimizerOf, KernelsAndPositionsCount) {
  IncrementalWalk<TypeParam> walk(40, 0.02, 6);
  for (Constraint& c : walk.graph.constraints) {
    auto& relative = std::get<RelativePoseConstraint>(c);
    if (relative.source == ConstraintSource::kLoop)
      relative.kernel = {RobustKernel::Kind::kCauchy, 1};
  }
  IncrementalOptimizer optimizer;
  feed<TypeParam>(optimizer, walk.graph, false, [](const IncrementalStep&) {});
  for (const int i : {0, 5, 10, 25, 39}) {
    PositionConstraint position;
    position.node = NodeId(10 + i);
    position.position_world.head(walk.truth[i].translation().size()) = walk.truth[i].translation();
    optimizer.add({}, {position});
  }
  optimizer.finish();
  const double cost = optimizer.cost();
  IncrementalOptimizer again;
  const PoseGraph solved = optimize_pose_graph(optimizer.graph(), tight()).graph;
  again.add(solved.nodes, solved.constraints);
  again.finish();
  EXPECT_NEAR(again.cost(), cost, 1e-5 * cost);
}

TYPED_TEST(IncrementalOptimizerOf, AConstraintThatIsNearlyInfiniteFailsUntilItIsRemoved) {
  IncrementalWalk<TypeParam> walk(10, 0.03, 10);
  IncrementalOptimizer optimizer;
  ASSERT_TRUE(optimizer.add(walk.graph.nodes, walk.graph.constraints).outcome);
  const auto before = std::get<TypeParam>(*optimizer.pose(NodeId(15))).matrix();
  RelativePoseConstraint huge = walk.measure(2, 8, 0);
  huge.information *= 1e306;
  const IncrementalStep step = optimizer.add({}, {huge});
  EXPECT_EQ(step.outcome.code, Outcome::Code::kNotConverged);
  EXPECT_EQ(std::get<TypeParam>(*optimizer.pose(NodeId(15))).matrix(), before);
  EXPECT_TRUE(optimizer.remove_constraint(step.first_constraint).outcome);
  EXPECT_TRUE(optimizer.finish().outcome);
  const double best = optimize_pose_graph(optimizer.graph(), tight()).chi2_final;
  EXPECT_NEAR(optimizer.cost(), best, 1e-6 * best);
}

TYPED_TEST(IncrementalOptimizerOf, TheGraphHoldsTheWeights) {
  for (const auto kind :
       {RobustKernel::Kind::kNone, RobustKernel::Kind::kHuber, RobustKernel::Kind::kCauchy,
        RobustKernel::Kind::kTukey, RobustKernel::Kind::kGemanMcClure, RobustKernel::Kind::kDcs,
        RobustKernel::Kind::kTruncated}) {
    IncrementalWalk<TypeParam> walk(10, 0.1, 11);
    for (Constraint& c : walk.graph.constraints)
      std::get<RelativePoseConstraint>(c).kernel = {kind, 2};
    IncrementalOptimizer optimizer;
    optimizer.add(walk.graph.nodes, walk.graph.constraints);
    optimizer.reweight({{0, 0.3}, {1, 4.0}});
    const PoseGraph graph = optimizer.graph();
    double cost = 0;
    for (const Constraint& c : graph.constraints) {
      const auto& relative = std::get<RelativePoseConstraint>(c);
      PoseGraph one{graph.nodes, {c}};
      cost += relative.kernel.evaluate(chi2(one, RotationError::kLog)).rho;
    }
    EXPECT_NEAR(cost, optimizer.cost(), 1e-9 * cost) << static_cast<int>(kind);
  }
}

TYPED_TEST(IncrementalOptimizerOf, CovarianceOfAChainIsComputedByHand) {
  IncrementalWalk<TypeParam> walk(2, 0, 7);
  IncrementalOptimizer optimizer;
  optimizer.add(walk.graph.nodes, walk.graph.constraints);
  // One edge of information 100 from the held node.
  const Eigen::MatrixXd covariance = optimizer.covariance({NodeId(10), NodeId(11)});
  constexpr int dof = TypeParam::kDof;
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(2 * dof, 2 * dof);
  expected.bottomRightCorner(dof, dof).diagonal().setConstant(0.01);
  EXPECT_LT((covariance - expected).norm(), 1e-9);
}

TYPED_TEST(IncrementalOptimizerOf, ARevisedConstraintIsAsIfItHadBeenMeasuredSo) {
  IncrementalWalk<TypeParam> walk(40, 0.03, 10), other(40, 0.03, 11);
  IncrementalOptimizer optimizer;
  feed<TypeParam>(optimizer, walk.graph, false, [](const IncrementalStep&) {});
  GraphChange change;
  for (int c = 0; c < optimizer.constraints(); c += 7) {
    auto measured = std::get<RelativePoseConstraint>(optimizer.constraint(c));
    measured.T_from_to = other
                             .measure(static_cast<int>(measured.from.value()) - 10,
                                      static_cast<int>(measured.to.value()) - 10, 0.03)
                             .T_from_to;
    measured.information *= 4;
    change.revised.push_back({c, measured});
  }
  optimizer.apply(change);
  optimizer.finish();
  const PoseGraph graph = optimizer.graph();
  EXPECT_EQ(std::get<RelativePoseConstraint>(graph.constraints[7]).information(0, 0), 400);
  EXPECT_NEAR(chi2(graph, RotationError::kLog), optimizer.cost(), 1e-9 * optimizer.cost());
  const double best = optimize_pose_graph(graph, tight()).chi2_final;
  EXPECT_NEAR(optimizer.cost(), best, 1e-6 * best);
}

TYPED_TEST(IncrementalOptimizerOf, BeginsWithAGraphAtItsPoses) {
  const IncrementalWalk<TypeParam> walk(40, 0.03, 12);
  const PoseGraph solved = optimize_pose_graph(walk.graph, tight()).graph;
  IncrementalOptimizer optimizer({}, solved);
  const IncrementalStep step = optimizer.apply({});
  EXPECT_EQ(step.iterations, 0);
  for (const PoseNode& node : solved.nodes)
    EXPECT_EQ(std::get<TypeParam>(*optimizer.pose(node.id)).matrix(),
              std::get<TypeParam>(node.T_world_node).matrix());
}

TYPED_TEST(IncrementalOptimizerOf, RelativeCovarianceIsThatOfTheWholeGraph) {
  const IncrementalWalk<TypeParam> walk(40, 0.03, 13);
  IncrementalOptions options;
  options.relinearization = 0;
  IncrementalOptimizer optimizer(options);
  feed<TypeParam>(optimizer, walk.graph, false, [](const IncrementalStep&) {});
  optimizer.finish();
  const PoseMarginals marginals(optimizer.graph());
  const Information expected = marginals.relative_covariance(NodeId(15), NodeId(40));
  EXPECT_LT((optimizer.relative_covariance(NodeId(15), NodeId(40)) - expected).norm(),
            1e-3 * expected.norm());
}

TEST(IncrementalOptimizer, RefusesWhatDoesNotFitAndChangesNothing) {
  IncrementalOptimizer optimizer;
  EXPECT_FALSE(optimizer.pose(NodeId(0)));
  IncrementalWalk<SE2> walk(3, 0, 8);
  EXPECT_THROW(optimizer.add({}, walk.graph.constraints), ArgumentError);
  optimizer.add(walk.graph.nodes, walk.graph.constraints);
  EXPECT_THROW(optimizer.add({walk.graph.nodes[1]}, {}), ArgumentError);
  EXPECT_THROW(optimizer.add({{NodeId(99), SE3(), false}}, {}), ArgumentError);
  EXPECT_THROW(optimizer.reweight({{7, 1.0}}), ArgumentError);
  EXPECT_THROW(optimizer.reweight({{0, -1.0}}), ArgumentError);
  EXPECT_THROW((void)optimizer.covariance({NodeId(99)}), ArgumentError);
  RelativePoseConstraint elsewhere = walk.measure(0, 2, 0);
  EXPECT_THROW(optimizer.apply({{}, {}, {{0, elsewhere}}, {}}), ArgumentError);
  EXPECT_THROW(optimizer.apply({{}, {}, {{7, elsewhere}}, {}}), ArgumentError);
  EXPECT_THROW((void)optimizer.relative_covariance(NodeId(10), NodeId(99)), ArgumentError);
  optimizer.add({{NodeId(50), SE2(), false}}, {});
  EXPECT_THROW((void)optimizer.relative_covariance(NodeId(10), NodeId(50)), ArgumentError);
  IncrementalOptions bad;
  bad.excess = 0;
  EXPECT_THROW(IncrementalOptimizer{bad}, ArgumentError);
  EXPECT_EQ(optimizer.graph().nodes.size(), 4u);
}

TEST(IncrementalOptimizer, TwoRunsGiveTheSameBits) {
  const IncrementalWalk<SE3> walk(60, 0.03, 9);
  const IncrementalReplay a = optimize_incrementally(walk.graph);
  const IncrementalReplay b = optimize_incrementally(walk.graph);
  EXPECT_EQ(a.cost, b.cost);
  for (std::size_t i = 0; i < walk.graph.nodes.size(); ++i)
    EXPECT_EQ(std::get<SE3>(a.graph.nodes[i].T_world_node).matrix(),
              std::get<SE3>(b.graph.nodes[i].T_world_node).matrix());
}

}  // namespace incremental_optimizer_test
}  // namespace placegraph
