#include <gtest/gtest.h>
#include <placegraph/backend/robust/gnc.h>

#include <cmath>

#include "tests/support/message_of.h"
#include "tests/support/packed_graphs.h"
#include "tests/support/scenes/looped_walk.h"

namespace placegraph {
namespace gnc_test {

constexpr double kGate = 30;  // noise as stated exceeds it once in a million loops

template <class Group>
class GncOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(GncOf, Groups);

TYPED_TEST(GncOf, LeavesOutTheFalseLoopsAndHardlyAnyOther) {
  const test::LoopedWalk<TypeParam> walk(
      {.nodes = 80, .lap = 20, .noise = 0.02, .claimed = 0.02, .false_loops = 8, .seed = 3});
  for (const GncSurrogate surrogate : {GncSurrogate::kTruncated, GncSurrogate::kGemanMcClure}) {
    PackedGraph<TypeParam> graph = pack<TypeParam>(walk.graph);
    graph.edges[5].weight = 0.5;
    const GncSolution solution =
        graduated_non_convexity(graph, kGate, {}, {.surrogate = surrogate});
    EXPECT_TRUE(solution.local.outcome) << solution.local.outcome.reason;
    EXPECT_GT(solution.rounds, 1);
    const std::vector<double> chi2 = chi2_by_edge(graph, RotationError::kLog);
    int lost = 0;
    for (std::size_t i = 0; i < graph.edges.size(); ++i) {
      const auto& edge = graph.edges[i];
      const bool is_true = edge.constraint < static_cast<int>(walk.true_constraints);
      if (edge.odometry) {
        EXPECT_EQ(edge.weight, i == 5 ? 0.5 : 1) << "edge " << i;
        continue;
      }
      EXPECT_EQ(edge.weight, chi2[i] <= kGate ? 1 : 0) << "edge " << i;
      EXPECT_TRUE(is_true || edge.weight == 0) << "edge " << i;
      lost += is_true && edge.weight == 0;
    }
    // The schedule is a heuristic: a true loop between false ones may go with them.
    EXPECT_LE(lost, 1);
    EXPECT_NEAR(solution.local.cost_final, robust_cost(graph, RotationError::kLog),
                1e-9 * solution.local.cost_final);
  }
}

TYPED_TEST(GncOf, OfTrueLoopsIsThePlainMinimum) {
  const test::LoopedWalk<TypeParam> walk({.nodes = 60, .lap = 20, .claimed = 0.02});
  LocalSolverOptions tight;
  tight.relative_decrease = 1e-14;
  PackedGraph<TypeParam> graph = pack<TypeParam>(walk.graph), plain = graph;
  (void)LocalSolver<TypeParam>(tight).solve(plain);
  (void)graduated_non_convexity(graph, 2 * kGate, tight, {});
  for (const auto& edge : graph.edges) EXPECT_EQ(edge.weight, 1);
  EXPECT_LT(test::distance(graph.poses, plain.poses), 1e-5);
}

TEST(Gnc, NeverTakesALoopThatWasExcluded) {
  const test::LoopedWalk<SE2> walk({.nodes = 60, .lap = 20, .claimed = 0.02});
  PackedGraph<SE2> graph = pack<SE2>(walk.graph);
  std::size_t loops = 0;
  for (auto& edge : graph.edges)
    if (!edge.odometry) edge.weight = ++loops % 3 == 0 ? 0 : 0.3;
  loops = 0;
  (void)graduated_non_convexity(graph, 2 * kGate, {}, {});
  for (const auto& edge : graph.edges) {
    const bool excluded = !edge.odometry && ++loops % 3 == 0;
    EXPECT_EQ(edge.weight, excluded ? 0 : 1) << "constraint " << edge.constraint;
  }
}

TEST(Gnc, DecidesByTheGateBetweenNodesThatCannotMove) {
  PackedGraph<SE2> graph;
  graph.poses.resize(2);
  graph.components.held = {true, true};
  for (const double share : {0.5, 0.99, 1.01, 3.0, 100.0})
    graph.edges.push_back({0,
                           1,
                           0,
                           false,
                           SE2(std::sqrt(share * kGate), 0, 0),
                           SE2::Jacobian(SE2::Jacobian::Identity()),
                           {}});
  for (const GncSurrogate surrogate : {GncSurrogate::kTruncated, GncSurrogate::kGemanMcClure}) {
    (void)graduated_non_convexity(graph, kGate, {}, {.surrogate = surrogate});
    for (int i = 0; i < 5; ++i) {
      EXPECT_EQ(graph.edges[i].weight, i < 2 ? 1 : 0) << "loop " << i;
      graph.edges[i].weight = 1;
    }
  }
}

TEST(Gnc, WithoutLoopsKeepsTheOdometry) {
  PackedGraph<SE3> graph = pack<SE3>(test::LoopedWalk<SE3>({.nodes = 10}).graph);
  const std::vector<SE3> start = graph.poses;
  const GncSolution solution = graduated_non_convexity(graph, kGate, {}, {});
  EXPECT_EQ(solution.rounds, 0);
  EXPECT_LT(test::distance(graph.poses, start), 1e-9);
}

TEST(Gnc, RefusesAGateThatIsNotPositive) {
  PackedGraph<SE2> graph = pack<SE2>(test::LoopedWalk<SE2>({.nodes = 10}).graph);
  const std::string message =
      test::message_of<ArgumentError>([&] { (void)graduated_non_convexity(graph, 0, {}, {}); });
  EXPECT_NE(message.find("gate must be positive"), std::string::npos) << message;
  EXPECT_THROW((void)graduated_non_convexity(graph, 1, {}, {.least_factor = 0.5}), ArgumentError);
}

}  // namespace gnc_test
}  // namespace placegraph
