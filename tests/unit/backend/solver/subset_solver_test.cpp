#include <gtest/gtest.h>
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/solver/subset_solver.h>

#include "tests/support/packed_graphs.h"

namespace placegraph {
namespace subset_solver_test {

LocalSolverOptions tight() {
  LocalSolverOptions options;
  options.relative_decrease = 1e-14;
  return options;
}

/// The graph without the edges that have no weight.
template <class Group>
PackedGraph<Group> without_idle_edges(PackedGraph<Group> graph) {
  std::erase_if(graph.edges, [](const auto& edge) { return edge.weight == 0; });
  return graph;
}

template <class Group>
class SubsetSolverOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(SubsetSolverOf, Groups);

/// One solver meets sets of loops that shrink a little, much, and grow again.
TYPED_TEST(SubsetSolverOf, SolvesEverySetOfLoopsAsAGraphOfItsOwn) {
  PackedGraph<TypeParam> graph = test::packed_walk<TypeParam>(24, 0.05, 1);
  const std::vector<TypeParam> start = graph.poses;
  const std::size_t edges = graph.edges.size();
  SubsetSolver<TypeParam> solver(tight());
  Random random(2);
  for (const double share : {1.0, 0.95, 0.9, 0.3, 0.0, 0.5, 1.0}) {
    for (auto& edge : graph.edges)
      edge.weight = edge.odometry || random.uniform() < share ? random.uniform(0.5, 2) : 0;
    graph.poses = start;
    PackedGraph<TypeParam> expected = without_idle_edges(graph);
    const double cost = LocalSolver<TypeParam>(tight()).solve(expected).cost_final;
    const LocalSolution solution = solver.solve(graph);
    EXPECT_TRUE(solution.outcome) << "share " << share << ": " << solution.outcome.reason;
    // Odometry alone reaches a cost of rounding.
    EXPECT_NEAR(solution.cost_final, cost, 1e-9 * cost + 1e-12) << "share " << share;
    EXPECT_LT(test::distance(graph.poses, expected.poses), 1e-5) << "share " << share;
    EXPECT_EQ(graph.edges.size(), edges);
  }
}

TYPED_TEST(SubsetSolverOf, HasTheCostOfTheWholeGraph) {
  PackedGraph<TypeParam> graph = test::packed_walk<TypeParam>(16, 0.05, 3);
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    if (!graph.edges[i].odometry) graph.edges[i].weight = i % 2;
    graph.edges[i].kernel = {RobustKernel::Kind::kHuber, 1.5};
  }
  graph.positions.push_back({3, 0, {1, 1, 0}, {0, 0, 0}, Eigen::Matrix3d::Identity(), {}});
  const double before = robust_cost(graph, RotationError::kQuaternion);
  LocalSolverOptions options = tight();
  options.rotation_error = RotationError::kQuaternion;
  const LocalSolution solution = SubsetSolver<TypeParam>(options).solve(graph);
  EXPECT_NEAR(solution.cost_initial, before, 1e-10 * before);
  const double after = robust_cost(graph, RotationError::kQuaternion);
  EXPECT_NEAR(solution.cost_final, after, 1e-10 * after);
  EXPECT_LT(after, before);
}

TYPED_TEST(SubsetSolverOf, SumsTheSquaredErrorsOfEdgesAndPositions) {
  PackedGraph<TypeParam> graph = test::packed_walk<TypeParam>(10, 0.1, 4);
  Random random(5);
  for (auto& edge : graph.edges) {
    edge.weight = random.uniform(0, 3);
    edge.kernel = {RobustKernel::Kind::kGemanMcClure, random.uniform(1, 3)};
  }
  graph.positions = {
      {4, 0, {1, 2, 0}, {0, 0, 0}, test::random_information<Eigen::Matrix3d>(random), {}, 2}};
  double cost = 0;
  const std::vector<double> chi2 = chi2_by_edge(graph, RotationError::kLog);
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto& edge = graph.edges[i];
    // The error is not changed by where the world is.
    const TypeParam T_from_world = graph.poses[edge.from].inverse();
    const auto e = (edge.T_to_from * T_from_world * graph.poses[edge.to]).log();
    EXPECT_NEAR(chi2[i], e.dot(edge.information * e), 1e-10 * chi2[i]);
    const double b = edge.kernel.width * edge.kernel.width;
    cost += edge.weight * chi2[i] * b / (b + chi2[i]);
  }
  constexpr int dim = TypeParam::kDof == 3 ? 2 : 3;
  Eigen::Vector3d off = Eigen::Vector3d::Zero();
  off.template head<dim>() =
      graph.poses[4].translation() - Eigen::Vector3d(1, 2, 0).template head<dim>();
  const double at_position = off.dot(graph.positions[0].information * off);
  ASSERT_EQ(chi2_by_position(graph).size(), 1u);
  EXPECT_NEAR(chi2_by_position(graph)[0], at_position, 1e-10 * at_position);
  cost += 2 * at_position;
  EXPECT_NEAR(robust_cost(graph, RotationError::kLog), cost, 1e-10 * cost);
}

}  // namespace subset_solver_test
}  // namespace placegraph
