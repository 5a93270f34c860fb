#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/looped_walk.h"

namespace placegraph {
namespace robust_optimizer_test {

using test::LoopedWalk;

PoseGraphReport optimize(const PoseGraph& graph, RobustMethod method) {
  PoseGraphOptions options;
  options.robust.method = method;
  return optimize_pose_graph(graph, options);
}

/// Largest distance between the positions of two estimates that hold the same first node [m].
template <class Group>
double worst_distance(const PoseGraph& a, const PoseGraph& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    worst = std::max(worst, (std::get<Group>(a.nodes[i].T_world_node).translation() -
                             std::get<Group>(b.nodes[i].T_world_node).translation())
                                .norm());
  return worst;
}

template <class Group>
PoseGraph without_false_loops(const LoopedWalk<Group>& walk) {
  PoseGraph graph = walk.graph;
  graph.constraints.resize(walk.true_constraints);
  return graph;
}

TEST(RobustOptimizer, KernelsOnLoopsHoldAFewFalseOnesOff) {
  const LoopedWalk<SE2> walk({.nodes = 150, .false_loops = 1});
  const PoseGraph best = optimize(without_false_loops(walk), RobustMethod::kNone).graph;
  const double plain = worst_distance<SE2>(optimize(walk.graph, RobustMethod::kNone).graph, best);
  for (const RobustMethod method : {RobustMethod::kHuber, RobustMethod::kDcs}) {
    const PoseGraphReport report = optimize(walk.graph, method);
    EXPECT_TRUE(report.outcome) << report.outcome.reason;
    EXPECT_TRUE(report.rejected.empty());
    EXPECT_LT(worst_distance<SE2>(report.graph, best), 0.5 * plain);
  }
}

TEST(RobustOptimizer, GraduatedNonConvexityLeavesTheFalseLoopsOutAndSaysSo) {
  for (const GncSurrogate surrogate : {GncSurrogate::kTruncated, GncSurrogate::kGemanMcClure}) {
    const LoopedWalk<SE2> walk({.nodes = 150, .false_loops = 10});
    PoseGraphOptions options;
    options.robust.method = RobustMethod::kGnc;
    options.robust.gnc.surrogate = surrogate;
    const PoseGraphReport report = optimize_pose_graph(walk.graph, options);
    EXPECT_TRUE(report.outcome) << report.outcome.reason;
    ASSERT_EQ(report.rejected.size(), 10u);
    for (std::size_t i = 0; i < 10; ++i) {
      EXPECT_EQ(report.rejected[i].constraint, static_cast<int>(walk.true_constraints + i));
      EXPECT_THAT(report.rejected[i].reason,
                  testing::AnyOf("inconsistent with odometry", "pairwise", "residual"));
      EXPECT_NEAR(report.rejected[i].chi2, report.chi2_by_constraint[walk.true_constraints + i],
                  1e-9);
    }
    const PoseGraph best = optimize(without_false_loops(walk), RobustMethod::kNone).graph;
    EXPECT_LT(worst_distance<SE2>(report.graph, best), 1e-4);
  }
}

TEST(RobustOptimizer, GraduatedNonConvexityRejectsAGroupThatBendsTheOdometry) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    SCOPED_TRACE(seed);
    const LoopedWalk<SE2> walk({.claimed = 0.02, .false_loops = 20, .cluster = 20, .seed = seed});
    const PoseGraphReport report = optimize(walk.graph, RobustMethod::kGnc);
    EXPECT_TRUE(report.outcome) << report.outcome.reason;
    ASSERT_EQ(report.rejected.size(), 20u);
    for (const RejectedEdge& edge : report.rejected)
      EXPECT_GE(edge.constraint, static_cast<int>(walk.true_constraints));
  }
}

TEST(RobustOptimizer, RefusesOptionsOutsideTheirRange) {
  PoseGraphOptions options;
  options.robust.gate_probability = 1;
  EXPECT_THROW(options.check(), ArgumentError);
  options.robust = {};
  options.robust.gnc.least_factor = 1;
  EXPECT_THROW(options.check(), ArgumentError);
}

}  // namespace robust_optimizer_test
}  // namespace placegraph
