#include <gtest/gtest.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>

namespace placegraph {
namespace rigid_graph_test {

/// Nodes of other units; edges are measured exactly.
PoseGraph scaled_walk() {
  PoseGraph graph;
  const std::vector<Sim3> nodes = {{SO3(), Eigen::Vector3d(0, 0, 0), 1},
                                   {SO3::exp({0, 0.3, 0}), Eigen::Vector3d(1, 0, 0.2), 1.5},
                                   {SO3::exp({0.1, 0.9, 0}), Eigen::Vector3d(1.5, 0.1, 1.4), 0.7}};
  for (std::size_t i = 0; i < nodes.size(); ++i)
    graph.nodes.push_back({NodeId(i), nodes[i], false});
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    RelativePoseConstraint edge;
    edge.from = NodeId(i);
    edge.to = NodeId(i + 1);
    edge.T_from_to = nodes[i].inverse() * nodes[i + 1];
    edge.information = Information::Identity(7, 7) * 9;
    edge.information(0, 6) = edge.information(6, 0) = 3;
    graph.constraints.emplace_back(edge);
  }
  return graph;
}

TEST(RigidGraph, StandsWhereTheSimilaritiesDid) {
  const PoseGraph graph = scaled_walk(), rigid = rigid_graph(graph);
  rigid.check();
  ASSERT_EQ(rigid.kind(), PoseKind::kSE3);
  for (const Constraint& constraint : rigid.constraints) {
    const auto& edge = std::get<RelativePoseConstraint>(constraint);
    const auto pose = [&](NodeId id) {
      return std::get<SE3>(rigid.nodes[static_cast<std::size_t>(id.value())].T_world_node);
    };
    const SE3 error =
        std::get<SE3>(edge.T_from_to).inverse() * pose(edge.from).inverse() * pose(edge.to);
    EXPECT_LT(error.log().norm(), 1e-12);
  }
  // Translations of the second edge are 1.5 times as long; the scale is marginalized: 9 - 3^2 / 9.
  const auto& edge = std::get<RelativePoseConstraint>(rigid.constraints[1]);
  EXPECT_NEAR(edge.information(0, 0), (9 - 1.0) / (1.5 * 1.5), 1e-12);
  EXPECT_NEAR(edge.information(1, 1), 9 / (1.5 * 1.5), 1e-12);
  EXPECT_NEAR(edge.information(3, 3), 9, 1e-12);
}

TEST(RigidGraph, LeavesPosesAsTheyAre) {
  PoseGraph graph;
  graph.nodes.push_back({NodeId(3), SE2(1, 2, 3), true});
  EXPECT_EQ(rigid_graph(graph).kind(), PoseKind::kSE2);
  EXPECT_EQ(rigid_graph(graph).nodes[0].id, NodeId(3));
}

}  // namespace rigid_graph_test
}  // namespace placegraph
