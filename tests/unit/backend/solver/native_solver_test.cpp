#include <gtest/gtest.h>
#include <placegraph/backend/solver/ceres_solver.h>
#include <placegraph/backend/solver/local_solver.h>
#include <placegraph/backend/solver/native_solver.h>

#include "tests/support/packed_graphs.h"

namespace placegraph {
namespace native_solver_test {

constexpr RotationError kLog = RotationError::kLog;

LocalSolverOptions tight(StepRule step_rule = StepRule::kDogleg) {
  LocalSolverOptions options;
  options.step_rule = step_rule;
  options.relative_decrease = 1e-14;
  return options;
}

template <class Group>
class NativeSolverOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(NativeSolverOf, Groups);

TYPED_TEST(NativeSolverOf, ReachesTheMinimumOfCeresByEveryStepRule) {
  const PackedGraph<TypeParam> start = test::packed_walk<TypeParam>(20, 0.03, 1);
  PackedGraph<TypeParam> expected = start;
  const LocalSolution reference = solve_with_ceres(expected, tight());
  ASSERT_TRUE(reference.outcome) << reference.outcome.reason;
  for (const StepRule rule :
       {StepRule::kDogleg, StepRule::kGaussNewton, StepRule::kLevenbergMarquardt}) {
    PackedGraph<TypeParam> graph = start;
    const LocalSolution solution = NativeSolver<TypeParam>(tight(rule)).solve(graph);
    EXPECT_TRUE(solution.outcome) << solution.outcome.reason;
    EXPECT_NEAR(solution.cost_initial, robust_cost(start, kLog), 1e-10 * solution.cost_initial);
    EXPECT_NEAR(solution.cost_final, robust_cost(graph, kLog), 1e-10 * solution.cost_final);
    EXPECT_NEAR(solution.cost_final, reference.cost_final, 1e-10 * reference.cost_final);
    // At a minimum poses are known to the root of what the cost is known to.
    EXPECT_LT(test::distance(graph.poses, expected.poses), 1e-5);
    EXPECT_EQ(solution.regular, rule != StepRule::kLevenbergMarquardt);
    EXPECT_EQ(graph.poses[0].matrix(), start.poses[0].matrix()) << "the held node";
  }
}

TYPED_TEST(NativeSolverOf, FollowsAnotherWorldFrame) {
  PackedGraph<TypeParam> graph = test::packed_walk<TypeParam>(15, 0.05, 2), moved = graph;
  Random random(3);
  const auto T_new_old = test::random_element<TypeParam>(random, 10, 1);
  for (TypeParam& pose : moved.poses) pose = T_new_old * pose;
  const double cost = NativeSolver<TypeParam>(tight()).solve(graph).cost_final;
  EXPECT_NEAR(NativeSolver<TypeParam>(tight()).solve(moved).cost_final, cost, 1e-9 * cost);
  for (TypeParam& pose : graph.poses) pose = T_new_old * pose;
  EXPECT_LT(test::distance(graph.poses, moved.poses), 1e-5);
}

TYPED_TEST(NativeSolverOf, CountsAWeightAsThatManyCopies) {
  PackedGraph<TypeParam> weighted = test::packed_walk<TypeParam>(12, 0.05, 4), copied = weighted;
  for (std::size_t i = 0; i < weighted.edges.size(); i += 3) {
    weighted.edges[i].weight = 3;
    copied.edges.push_back(copied.edges[i]);
    copied.edges.push_back(copied.edges[i]);
  }
  weighted.edges[4].weight = 0;
  copied.edges.erase(copied.edges.begin() + 4);
  const double cost = NativeSolver<TypeParam>(tight()).solve(copied).cost_final;
  EXPECT_NEAR(NativeSolver<TypeParam>(tight()).solve(weighted).cost_final, cost, 1e-10 * cost);
  EXPECT_LT(test::distance(weighted.poses, copied.poses), 1e-6);
}

TYPED_TEST(NativeSolverOf, NeverRaisesTheCostFromFarStartsWithKernels) {
  Random random(5);
  for (const StepRule rule : {StepRule::kDogleg, StepRule::kLevenbergMarquardt})
    for (int iterations = 1; iterations <= 3; ++iterations) {
      PackedGraph<TypeParam> graph = test::packed_walk<TypeParam>(15, 0.1, 6);
      for (auto& edge : graph.edges) edge.kernel = {RobustKernel::Kind::kCauchy, 2};
      for (std::size_t i = 1; i < graph.poses.size(); ++i)
        graph.poses[i] = graph.poses[i] * test::random_element<TypeParam>(random, 2, 0.6);
      LocalSolverOptions options = tight(rule);
      options.max_iterations = iterations;
      const LocalSolution solution = NativeSolver<TypeParam>(options).solve(graph);
      EXPECT_EQ(solution.outcome.code, Outcome::Code::kNotConverged);
      EXPECT_EQ(solution.iterations, iterations);
      EXPECT_LE(solution.cost_final, solution.cost_initial);
      EXPECT_NEAR(solution.cost_final, robust_cost(graph, kLog), 1e-9 * solution.cost_final);
    }
}

TYPED_TEST(NativeSolverOf, SolvesAgainWithOtherWeightsAndPosesAsIfItWereNew) {
  PackedGraph<TypeParam> graph = test::packed_walk<TypeParam>(15, 0.05, 7);
  const std::vector<TypeParam> start = graph.poses;
  NativeSolver<TypeParam> solver(tight());
  (void)solver.solve(graph);
  for (std::size_t i = 0; i < graph.edges.size(); i += 2) graph.edges[i].weight = 0.1;
  graph.edges.back().weight = 0;
  graph.poses = start;
  PackedGraph<TypeParam> again = graph;
  const double cost = NativeSolver<TypeParam>(tight()).solve(graph).cost_final;
  EXPECT_NEAR(solver.solve(again).cost_final, cost, 1e-10 * cost);
  EXPECT_LT(test::distance(graph.poses, again.poses), 1e-6);
}

TYPED_TEST(NativeSolverOf, ReachesZeroCostButNoUniqueMinimumWhereDirectionsAreFree) {
  PackedGraph<TypeParam> graph = test::packed_walk<TypeParam>(8, 0, 8);
  graph.components.held.assign(graph.components.held.size(), false);
  graph.positions = {
      {2, 0, {3, -1, 0}, {0.5, 0.2, 0}, 25 * Eigen::Matrix3d::Identity(), RobustKernel()}};
  const LocalSolution solution = NativeSolver<TypeParam>({}).solve(graph);
  EXPECT_TRUE(solution.outcome) << solution.outcome.reason;
  EXPECT_FALSE(solution.regular);
  EXPECT_LT(solution.cost_final, 1e-9 * solution.cost_initial);
}

template <class Group>
class MeanOfMotions : public testing::Test {};
using RigidGroups = testing::Types<SE2, SE3>;
TYPED_TEST_SUITE(MeanOfMotions, RigidGroups);

/// Without rotations and with isotropic information the minimum is the weighted mean.
TYPED_TEST(MeanOfMotions, IsTheWeightedMeanOfTranslations) {
  using Point = typename TypeParam::Point;
  Random random(9);
  PackedGraph<TypeParam> graph;
  graph.poses.resize(2);
  graph.components.held = {true, false};
  Point sum = Point::Zero();
  double weights = 0;
  for (int i = 0; i < 10; ++i) {
    Point t;
    for (double& coordinate : t) coordinate = random.normal();
    const double information = random.uniform(1, 9), weight = random.uniform(0.5, 2);
    graph.edges.push_back({0,
                           1,
                           i,
                           false,
                           TypeParam(decltype(TypeParam().rotation().inverse()){}, -t),
                           information * TypeParam::Jacobian::Identity(),
                           {},
                           weight});
    sum += weight * information * t;
    weights += weight * information;
  }
  EXPECT_TRUE(NativeSolver<TypeParam>(tight()).solve(graph).outcome);
  EXPECT_LT((graph.poses[1].translation() - sum / weights).norm(), 1e-7);
  EXPECT_LT(graph.poses[1].rotation().log().norm(), 1e-7);
}

TEST(NativeSolver, OfHeldNodesHasNothingToDo) {
  PackedGraph<SE3> graph = test::packed_walk<SE3>(6, 0.1, 10);
  graph.components.held.assign(graph.components.held.size(), true);
  const double cost = robust_cost(graph, kLog);
  const LocalSolution solution = NativeSolver<SE3>({}).solve(graph);
  EXPECT_TRUE(solution.outcome);
  EXPECT_EQ(solution.iterations, 0);
  EXPECT_NEAR(solution.cost_final, cost, 1e-10 * cost);
}

}  // namespace native_solver_test
}  // namespace placegraph
