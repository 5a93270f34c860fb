#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/synthetic/graphs/graph_world.h>

#include <algorithm>

#include "tests/support/edge_of.h"

namespace placegraph::synthetic {
namespace false_loops_test {

using test::edge_of;

/// Ten poses a metre apart on a straight line, loops over two and over three of them.
PoseGraph line_graph() {
  PoseGraph graph;
  for (int i = 0; i < 10; ++i) graph.nodes.push_back({NodeId(i), SE2(i, 0, 0), false});
  const auto measure = [&](int from, int to, ConstraintSource source) {
    graph.constraints.emplace_back(RelativePoseConstraint{NodeId(from),
                                                          NodeId(to),
                                                          SE2(to - from, 0, 0),
                                                          Information::Identity(3, 3) * (to - from),
                                                          source,
                                                          {}});
  };
  for (int i = 1; i < 10; ++i) measure(i - 1, i, ConstraintSource::kOdometry);
  measure(0, 2, ConstraintSource::kLoop);
  measure(5, 8, ConstraintSource::kLoop);
  return graph;
}

using Key = std::tuple<NodeId, NodeId, double>;
std::vector<Key> keys(const PoseGraph& graph) {
  std::vector<Key> out;
  for (std::size_t i = 0; i < graph.constraints.size(); ++i)
    out.emplace_back(edge_of(graph, i).from, edge_of(graph, i).to,
                     std::get<SE2>(edge_of(graph, i).T_from_to).translation()[0]);
  return out;
}

TEST(FalseLoops, AreMeasuredLikeTrueOnesBetweenPosesThatStandApart) {
  PoseGraph graph = line_graph();
  add_false_loops(graph, 200, 3);
  graph.check();
  ASSERT_EQ(graph.constraints.size(), 211u);
  bool over_two = false, over_three = false;
  for (std::size_t i = 11; i < 211; ++i) {
    const RelativePoseConstraint& loop = edge_of(graph, i);
    EXPECT_EQ(loop.source, ConstraintSource::kLoop);
    // A metre is more than 0.9 m, but that would be odometry.
    EXPECT_GE(loop.to.value() - loop.from.value(), 2);
    const double said_m = std::get<SE2>(loop.T_from_to).translation()[0];
    EXPECT_EQ(loop.information(0, 0), said_m);
    over_two |= said_m == 2;
    over_three |= said_m == 3;
  }
  EXPECT_TRUE(over_two && over_three);
}

TEST(FalseLoops, AreTheSameForTheSameSeed) {
  PoseGraph a = line_graph(), b = a, c = a;
  add_false_loops(a, 20, 1);
  add_false_loops(b, 20, 1);
  add_false_loops(c, 20, 2);
  EXPECT_EQ(keys(a), keys(b));
  EXPECT_NE(keys(a), keys(c));
}

TEST(FalseLoops, AreRefusedWhereNoneCanBe) {
  PoseGraph graph = line_graph();
  EXPECT_THROW(add_false_loops(graph, -1, 1), ArgumentError);
  EXPECT_THROW(add_false_loops(graph, 2000000000, 1), ArgumentError);
  add_false_loops(graph, 0, 1);
  EXPECT_EQ(graph.constraints.size(), 11u);
  for (PoseNode& node : graph.nodes) node.T_world_node = SE2();
  EXPECT_THROW(add_false_loops(graph, 1, 1), ArgumentError);
  graph.constraints.resize(9);
  EXPECT_THROW(add_false_loops(graph, 1, 1), ArgumentError);
}

TEST(FalseLoops, ShufflingLosesNoConstraintAndMovesMost) {
  const PoseGraph before = make_manhattan_walk({.poses = 300});
  PoseGraph after = before;
  shuffle_constraints(after, 1);
  std::vector<Key> a = keys(before), b = keys(after);
  int kept = 0;
  for (std::size_t i = 0; i < a.size(); ++i) kept += a[i] == b[i];
  EXPECT_LT(kept, 10);  // one on average
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  EXPECT_EQ(a, b);
}

}  // namespace false_loops_test
}  // namespace placegraph::synthetic
