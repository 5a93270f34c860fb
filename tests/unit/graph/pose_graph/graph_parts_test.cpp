#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/graph_parts.h>

namespace placegraph {
namespace graph_parts_test {

using testing::ElementsAre;
using testing::IsEmpty;

RelativePoseConstraint edge(std::int64_t from, std::int64_t to) {
  RelativePoseConstraint constraint;
  constraint.from = NodeId(from);
  constraint.to = NodeId(to);
  constraint.T_from_to = SE2();
  constraint.information = Eigen::Matrix3d::Identity();
  return constraint;
}

TEST(GraphParts, AreTheComponentsWithTheirConstraints) {
  PoseGraph graph;
  for (const std::int64_t id : {5, 6, 7, 8, 9}) graph.nodes.push_back({NodeId(id), SE2(), false});
  PositionConstraint position;
  position.node = NodeId(8);
  graph.constraints = {edge(6, 8), edge(9, 5), position};
  const std::vector<GraphPart> parts = split_components(graph);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_THAT(parts[0].nodes, ElementsAre(0, 4));
  EXPECT_THAT(parts[0].constraints, ElementsAre(1));
  EXPECT_THAT(parts[1].nodes, ElementsAre(1, 3));
  EXPECT_THAT(parts[1].constraints, ElementsAre(0, 2));
  EXPECT_THAT(parts[2].nodes, ElementsAre(2));
  EXPECT_THAT(parts[2].constraints, IsEmpty());
  for (const GraphPart& part : parts) {
    part.graph.check();
    EXPECT_EQ(part.graph.nodes.size(), part.nodes.size());
    EXPECT_EQ(part.graph.constraints.size(), part.constraints.size());
  }
  EXPECT_EQ(parts[1].graph.nodes[1].id, NodeId(8));
}

TEST(GraphParts, AreNoneOfAnEmptyGraph) { EXPECT_THAT(split_components({}), IsEmpty()); }

TEST(GraphParts, AreNotMadeOfAGraphWithUnknownNodes) {
  PoseGraph graph;
  graph.nodes = {{NodeId(1), SE2(), false}};
  graph.constraints = {edge(1, 2)};
  EXPECT_THROW(split_components(graph), ArgumentError);
}

}  // namespace graph_parts_test
}  // namespace placegraph
