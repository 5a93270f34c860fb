#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>

#include "tests/support/scenes/pose_walk.h"

namespace placegraph {
namespace pose_graph_optimizer_test {

using test::constraint;
using test::difference;
using test::isotropic;
using test::random_element;
using test::Walk;

PoseGraphOptions tight(RotationError convention = RotationError::kLog) {
  PoseGraphOptions options;
  options.relative_decrease = 1e-15;
  options.rotation_error = convention;
  return options;
}

template <class Group>
class PoseGraphOptimizerOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(PoseGraphOptimizerOf, Groups);

TYPED_TEST(PoseGraphOptimizerOf, RecoversAnExactGraphInBothConventions) {
  const Walk<TypeParam> walk(30, 0);
  for (const RotationError convention : {RotationError::kLog, RotationError::kQuaternion}) {
    const PoseGraphReport report = optimize_pose_graph(walk.graph, tight(convention));
    EXPECT_GT(report.chi2_initial, 1);
    EXPECT_LT(report.chi2_final, 1e-15);
    for (std::size_t i = 0; i < walk.truth.size(); ++i)
      EXPECT_LT(difference(walk.pose(report.graph, i), walk.truth[i]), 1e-8);
  }
}

TYPED_TEST(PoseGraphOptimizerOf, StopsWhereNoPerturbationLowersTheCost) {
  using Group = TypeParam;
  const Walk<Group> walk(20, 0.05);
  for (const RotationError convention : {RotationError::kLog, RotationError::kQuaternion}) {
    PoseGraph graph = optimize_pose_graph(walk.graph, tight(convention)).graph;
    const double best = chi2(graph, convention);
    EXPECT_GT(best, 1);
    for (std::size_t i = 1; i < graph.nodes.size(); ++i)
      for (int j = 0; j < Group::kDof; ++j)
        for (const double step : {-1e-3, 1e-3}) {
          PoseGraph moved = graph;
          moved.nodes[i].T_world_node =
              walk.pose(graph, i).plus(Group::Tangent::Unit(Group::kDof, j) * step);
          EXPECT_GT(chi2(moved, convention), best);
        }
  }
}

TYPED_TEST(PoseGraphOptimizerOf, MovingTheWholeGraphChangesNoCost) {
  using Group = TypeParam;
  const Walk<Group> walk(20, 0.05);
  Random random(5);
  const Group T_other_world = random_element<Group>(random, 20, 1);
  PoseGraph moved = walk.graph;
  for (PoseNode& node : moved.nodes)
    node.T_world_node = T_other_world * std::get<Group>(node.T_world_node);
  for (const RotationError convention : {RotationError::kLog, RotationError::kQuaternion}) {
    const PoseGraphReport a = optimize_pose_graph(walk.graph, tight(convention));
    const PoseGraphReport b = optimize_pose_graph(moved, tight(convention));
    EXPECT_NEAR(a.chi2_initial, b.chi2_initial, 1e-9 * a.chi2_initial);
    EXPECT_NEAR(a.chi2_final, b.chi2_final, 1e-9 * a.chi2_final);
    for (std::size_t i = 0; i < walk.truth.size(); ++i)
      EXPECT_LT(difference(T_other_world * walk.pose(a.graph, i), walk.pose(b.graph, i)), 1e-5);
  }
}

TYPED_TEST(PoseGraphOptimizerOf, TheOrderOfConstraintsDoesNotMatter) {
  const Walk<TypeParam> walk(20, 0.05);
  PoseGraph shuffled = walk.graph;
  Random random(6);
  for (std::size_t i = shuffled.constraints.size() - 1; i > 0; --i)
    std::swap(
        shuffled.constraints[i],
        shuffled.constraints[static_cast<std::size_t>(random.index(static_cast<int>(i) + 1))]);
  const PoseGraphReport a = optimize_pose_graph(walk.graph, tight());
  const PoseGraphReport b = optimize_pose_graph(shuffled, tight());
  EXPECT_NEAR(a.chi2_final, b.chi2_final, 1e-9 * a.chi2_final);
  for (std::size_t i = 0; i < walk.truth.size(); ++i)
    EXPECT_LT(difference(walk.pose(a.graph, i), walk.pose(b.graph, i)), 1e-5);
}

TYPED_TEST(PoseGraphOptimizerOf, PullOfAFalseLoopIsReducedByRobustKernels) {
  Walk<TypeParam> walk(30, 0.02);
  const auto worst_error = [&](RobustKernel kernel) {
    PoseGraph graph = walk.graph;
    // Node 7 said to be where node 20 is; the true loops carry the kernel too.
    graph.constraints.emplace_back(constraint<TypeParam>(17, 30, TypeParam()));
    for (Constraint& c : graph.constraints) {
      auto& relative = std::get<RelativePoseConstraint>(c);
      if (relative.source == ConstraintSource::kLoop) relative.kernel = kernel;
    }
    PoseGraphOptions options = tight();
    options.initialization = PoseGraphInitialization::kFile;
    const PoseGraphReport report = optimize_pose_graph(graph, options);
    double worst = 0;
    for (std::size_t i = 0; i < walk.truth.size(); ++i)
      worst = std::max(worst, difference(walk.pose(report.graph, i), walk.truth[i]));
    return worst;
  };
  const double without = worst_error({});
  EXPECT_GT(without, 0.5);
  EXPECT_LT(worst_error({RobustKernel::Kind::kHuber, 1}), 0.5 * without);
  // Redescending ones let go of it: what is left is little more than the noise of the rest.
  const PoseGraphReport clean = optimize_pose_graph(walk.graph, tight());
  double noise = 0;
  for (std::size_t i = 0; i < walk.truth.size(); ++i)
    noise = std::max(noise, difference(walk.pose(clean.graph, i), walk.truth[i]));
  EXPECT_LT(worst_error({RobustKernel::Kind::kCauchy, 1}), 1.5 * noise);
  EXPECT_LT(worst_error({RobustKernel::Kind::kDcs, 1}), 1.5 * noise);
}

TYPED_TEST(PoseGraphOptimizerOf, InformationMayLeaveDirectionsOpen) {
  using Group = TypeParam;
  Walk<Group> walk(12, 0);
  // Split every information into two of lower rank: the sum is the same.
  PoseGraph split = walk.graph;
  split.constraints.clear();
  for (const Constraint& c : walk.graph.constraints) {
    for (const bool first : {true, false}) {
      auto part = std::get<RelativePoseConstraint>(c);
      Eigen::MatrixXd direction = Eigen::MatrixXd::Ones(Group::kDof, 1).normalized();
      const Eigen::MatrixXd share = 100 * direction * direction.transpose();
      part.information = first ? Information(share) : Information(part.information - share);
      split.constraints.emplace_back(part);
    }
  }
  const PoseGraphReport a = optimize_pose_graph(walk.graph, tight());
  const PoseGraphReport b = optimize_pose_graph(split, tight());
  EXPECT_TRUE(b.outcome) << b.outcome.reason;
  EXPECT_NEAR(a.chi2_initial, b.chi2_initial, 1e-9 * a.chi2_initial);
  EXPECT_LT(b.chi2_final, 1e-12);
}

TYPED_TEST(PoseGraphOptimizerOf, ANodeThatIsOnlyPartlyDeterminedStaysFinite) {
  using Group = TypeParam;
  Walk<Group> walk(12, 0.02);
  // A leaf whose distance is not measured, as one eye alone gives it.
  auto leaf = constraint<Group>(21, 90, walk.truth[1]);
  leaf.information(0, 0) = 0;
  Random random(4);
  walk.graph.nodes.push_back(
      {NodeId(90), walk.truth[11] * random_element<Group>(random, 1, 0.3), false});
  const double before = optimize_pose_graph(walk.graph, tight()).chi2_final;
  walk.graph.constraints.emplace_back(leaf);
  for (const RotationError convention : {RotationError::kLog, RotationError::kQuaternion}) {
    const PoseGraphReport report = optimize_pose_graph(walk.graph, tight(convention));
    EXPECT_TRUE(report.outcome) << report.outcome.reason;
    EXPECT_TRUE(walk.pose(report.graph, 12).matrix().allFinite());
    EXPECT_LT(report.chi2_by_constraint.back(), 1e-12);
    if (convention == RotationError::kLog) {
      EXPECT_NEAR(report.chi2_final, before, 1e-9 * before);
    }
  }
}

TYPED_TEST(PoseGraphOptimizerOf, FixedNodesStayAndTheFirstMovesThen) {
  using Group = TypeParam;
  Walk<Group> walk(12, 0.02);
  walk.graph.nodes[5].fixed = true;
  const PoseGraphReport report = optimize_pose_graph(walk.graph, tight());
  EXPECT_EQ(walk.pose(report.graph, 5).matrix(), walk.pose(walk.graph, 5).matrix());
  EXPECT_GT(difference(walk.pose(report.graph, 0), walk.pose(walk.graph, 0)), 1e-3);
}

TYPED_TEST(PoseGraphOptimizerOf, ComponentsAreOptimizedApartAndLoneNodesStay) {
  using Group = TypeParam;
  const Walk<Group> first(12, 0.02, 1), second(12, 0.02, 2);
  PoseGraph both = first.graph;
  both.nodes.push_back({NodeId(5), Group(), false});  // without constraints
  for (PoseNode node : second.graph.nodes) {
    node.id = NodeId(node.id.value() + 100);
    both.nodes.push_back(node);
  }
  for (const Constraint& c : second.graph.constraints) {
    auto moved = std::get<RelativePoseConstraint>(c);
    moved.from = NodeId(moved.from.value() + 100);
    moved.to = NodeId(moved.to.value() + 100);
    both.constraints.emplace_back(moved);
  }
  const PoseGraphReport report = optimize_pose_graph(both, tight());
  EXPECT_TRUE(report.outcome);
  EXPECT_EQ(first.pose(report.graph, 12).matrix(), Group().matrix());
  EXPECT_EQ(first.pose(report.graph, 13).matrix(), second.pose(second.graph, 0).matrix());
  const double apart = optimize_pose_graph(first.graph, tight()).chi2_final +
                       optimize_pose_graph(second.graph, tight()).chi2_final;
  EXPECT_NEAR(report.chi2_final, apart, 1e-9 * apart);
}

TYPED_TEST(PoseGraphOptimizerOf, PositionsPlaceTheGraphInTheWorld) {
  using Group = TypeParam;
  Walk<Group> walk(20, 0);
  // Nothing holds the first node then: start the graph somewhere else.
  Random random(8);
  const Group T_other_world = random_element<Group>(random, 1, 0.3);
  for (PoseNode& node : walk.graph.nodes)
    node.T_world_node = T_other_world * std::get<Group>(node.T_world_node);
  for (std::size_t i = 0; i < walk.truth.size(); i += 3) {
    PositionConstraint position;
    position.node = NodeId(10 + static_cast<std::int64_t>(i));
    position.position_world = Eigen::Vector3d::Zero();
    position.position_world.head(walk.truth[i].translation().size()) = walk.truth[i].translation();
    walk.graph.constraints.emplace_back(position);
  }
  const PoseGraphReport report = optimize_pose_graph(walk.graph, tight());
  EXPECT_LT(report.chi2_final, 1e-12);
  for (std::size_t i = 0; i < walk.truth.size(); ++i)
    EXPECT_LT(difference(walk.pose(report.graph, i), walk.truth[i]), 1e-5);
}

TEST(PoseGraphOptimizer, ReportsTheSharesOfTheConstraints) {
  const Walk<SE3> walk(15, 0.05);
  const PoseGraphReport report = optimize_pose_graph(walk.graph, {});
  ASSERT_EQ(report.chi2_by_constraint.size(), walk.graph.constraints.size());
  double sum = 0;
  for (const double share : report.chi2_by_constraint) sum += share;
  EXPECT_NEAR(sum, report.chi2_final, 1e-12 * sum);
  EXPECT_NEAR(report.chi2_initial, chi2(walk.graph, RotationError::kLog), 1e-12);
  EXPECT_GT(report.iterations, 1);
  EXPECT_LT(report.chi2_final, report.chi2_initial);
}

TEST(PoseGraphOptimizer, Chi2OfOneEdgeIsComputedByHand) {
  PoseGraph graph;
  graph.nodes = {{NodeId(0), SE3(), false},
                 {NodeId(1), SE3(SO3::exp({0, 0, 0.4}), Eigen::Vector3d(1, 2, 0)), false}};
  graph.constraints.emplace_back(constraint<SE3>(0, 1, SE3(SO3(), Eigen::Vector3d(1, 0, 0)), 10));
  // E has the translation (0, 2, 0) and turns by 0.4.
  EXPECT_NEAR(chi2(graph, RotationError::kQuaternion), 10 * (4 + std::pow(std::sin(0.2), 2)),
              1e-12);
  // The log's translation is V^-1 t: longer by (0.4 / 2) / sin(0.4 / 2).
  EXPECT_NEAR(chi2(graph, RotationError::kLog), 10 * (4 * std::pow(0.2 / std::sin(0.2), 2) + 0.16),
              1e-12);
}

TEST(PoseGraphOptimizer, TellsWhenIterationsRanOut) {
  const Walk<SE2> walk(30, 0.05);
  PoseGraphOptions options;
  options.max_iterations = 1;
  options.initialization = PoseGraphInitialization::kFile;
  const PoseGraphReport report = optimize_pose_graph(walk.graph, options);
  EXPECT_EQ(report.outcome.code, Outcome::Code::kNotConverged);
  EXPECT_LT(report.chi2_final, report.chi2_initial);  // the evidence is there all the same
}

TEST(PoseGraphOptimizer, AGraphWithoutConstraintsIsAtItsOptimum) {
  PoseGraph graph;
  EXPECT_TRUE(optimize_pose_graph(graph, {}).outcome);
  graph.nodes.push_back({NodeId(3), SE2(1, 2, 3), false});
  const PoseGraphReport report = optimize_pose_graph(graph, {});
  EXPECT_TRUE(report.outcome);
  EXPECT_EQ(report.chi2_final, 0);
  EXPECT_EQ(report.graph.nodes.size(), 1u);
}

TEST(PoseGraphOptimizer, RefusesMixedKindsAndBadOptions) {
  PoseGraph mixed;
  mixed.nodes = {{NodeId(0), SE2(), false}, {NodeId(1), SE3(), false}};
  EXPECT_THROW((void)optimize_pose_graph(mixed, {}), ArgumentError);
  EXPECT_THROW((void)chi2(mixed, RotationError::kLog), ArgumentError);
  PoseGraphOptions bad;
  bad.max_iterations = 0;
  EXPECT_THROW((void)optimize_pose_graph(PoseGraph(), bad), ArgumentError);
}

TEST(PoseGraphOptimizer, TwoRunsGiveTheSameBitsAndTheLogIsHandedOver) {
  const Walk<SE3> walk(40, 0.05);
  std::vector<std::string> lines;
  const PoseGraphReport a = optimize_pose_graph(
      walk.graph, {}, [&](LogLevel, const std::string& line) { lines.push_back(line); });
  const PoseGraphReport b = optimize_pose_graph(walk.graph, {});
  EXPECT_THAT(lines, testing::Contains(testing::HasSubstr("chi2")));
  EXPECT_EQ(a.chi2_final, b.chi2_final);
  for (std::size_t i = 0; i < walk.truth.size(); ++i)
    EXPECT_EQ(walk.pose(a.graph, i).matrix(), walk.pose(b.graph, i).matrix());
}

}  // namespace pose_graph_optimizer_test
}  // namespace placegraph
