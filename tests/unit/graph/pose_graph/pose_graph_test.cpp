#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/node_index.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace placegraph {
namespace pose_graph_test {

using testing::ElementsAre;
using testing::HasSubstr;

RelativePoseConstraint relative(std::int64_t from, std::int64_t to,
                                ConstraintSource source = ConstraintSource::kOdometry) {
  RelativePoseConstraint constraint;
  constraint.from = NodeId(from);
  constraint.to = NodeId(to);
  constraint.T_from_to = SE3();
  constraint.information = Matrix6d::Identity();
  constraint.source = source;
  return constraint;
}

PoseGraph make_graph(const std::vector<std::int64_t>& ids,
                     const std::vector<RelativePoseConstraint>& constraints) {
  PoseGraph graph;
  for (const std::int64_t id : ids) graph.nodes.push_back({NodeId(id), SE3(), false});
  graph.constraints.assign(constraints.begin(), constraints.end());
  return graph;
}

/// The message of check() after `spoil`.
std::string complaint(const std::function<void(PoseGraph&)>& spoil) {
  PoseGraph graph = make_graph({7, 8}, {relative(7, 8)});
  PositionConstraint position;
  position.node = NodeId(8);
  graph.constraints.push_back(position);
  spoil(graph);
  try {
    graph.check();
  } catch (const ArgumentError& error) {
    return error.what();
  }
  return "accepted";
}

RelativePoseConstraint& edge(PoseGraph& graph) {
  return std::get<RelativePoseConstraint>(graph.constraints[0]);
}
PositionConstraint& position(PoseGraph& graph) {
  return std::get<PositionConstraint>(graph.constraints[1]);
}

TEST(PoseGraphCheck, AcceptsAGoodGraph) {
  EXPECT_EQ(complaint([](PoseGraph&) {}), "accepted");
  EXPECT_NO_THROW(PoseGraph().check());
}

TEST(PoseGraphCheck, RefusesMixedKinds) {
  EXPECT_THAT(complaint([](auto& g) { g.nodes[1].T_world_node = SE2(); }),
              HasSubstr("node 8: of another kind"));
  EXPECT_THAT(complaint([](auto& g) { edge(g).T_from_to = Sim3(); }),
              HasSubstr("constraint 0 (7 -> 8): of another kind"));
}

TEST(PoseGraphCheck, RefusesAnIdThatIsThereTwice) {
  EXPECT_THAT(complaint([](auto& g) {
                g.nodes.push_back({NodeId(7), SE3(), false});
              }),
              HasSubstr("node 7: the id is there twice"));
}

TEST(PoseGraphCheck, RefusesConstraintsOnUnknownNodes) {
  EXPECT_THAT(complaint([](auto& g) { edge(g).to = NodeId(9); }), HasSubstr("unknown node 9"));
  EXPECT_THAT(complaint([](auto& g) { edge(g).from = NodeId(-1); }), HasSubstr("unknown node -1"));
  EXPECT_THAT(complaint([](auto& g) { position(g).node = NodeId(3); }),
              HasSubstr("unknown node 3"));
}

TEST(PoseGraphCheck, RefusesAConstraintOfANodeWithItself) {
  EXPECT_THAT(complaint([](auto& g) { edge(g).to = NodeId(7); }),
              HasSubstr("joins a node to itself"));
}

TEST(PoseGraphCheck, RefusesWhatIsNotFinite) {
  const SE3 broken(SO3(), Eigen::Vector3d(0, NAN, 0));
  EXPECT_THAT(complaint([&](auto& g) { g.nodes[0].T_world_node = broken; }),
              HasSubstr("node 7: pose is not finite"));
  EXPECT_THAT(complaint([&](auto& g) { edge(g).T_from_to = broken; }),
              HasSubstr("constraint 0 (7 -> 8): pose is not finite"));
  EXPECT_THAT(complaint([](auto& g) { edge(g).information(2, 2) = INFINITY; }),
              HasSubstr("information is not finite"));
  EXPECT_THAT(complaint([](auto& g) { position(g).position_world[1] = NAN; }),
              HasSubstr("position is not finite"));
}

TEST(PoseGraphCheck, RefusesInformationOfTheWrongSize) {
  EXPECT_THAT(complaint([](auto& g) { edge(g).information = Eigen::Matrix3d::Identity(); }),
              HasSubstr("information is 3x3, not 6x6"));
  EXPECT_THAT(complaint([](auto& g) { edge(g).information = Information(); }),
              HasSubstr("information is 0x0, not 6x6"));
}

TEST(PoseGraphCheck, RefusesAsymmetricInformation) {
  EXPECT_THAT(complaint([](auto& g) { edge(g).information(0, 1) = 1e-3; }),
              HasSubstr("not symmetric"));
  EXPECT_THAT(complaint([](auto& g) { position(g).information(0, 1) = 1e-3; }),
              HasSubstr("constraint 1: information is not symmetric"));
}

TEST(PoseGraphCheck, RefusesIndefiniteInformationButNotRoundingBelowZero) {
  EXPECT_THAT(complaint([](auto& g) { edge(g).information(0, 0) = -1e-6; }),
              HasSubstr("indefinite"));
  EXPECT_THAT(complaint([](auto& g) { edge(g).information *= -1; }), HasSubstr("indefinite"));
  EXPECT_EQ(complaint([](auto& g) { edge(g).information(0, 0) = -1e-12; }), "accepted");
}

TEST(PoseGraphCheck, RefusesIndefiniteInformationNearTheLargestNumber) {
  EXPECT_THAT(complaint([](auto& g) {
                edge(g).information *= 1e300;
                edge(g).information(0, 1) = edge(g).information(1, 0) = 2e300;
              }),
              HasSubstr("indefinite"));
}

TEST(PoseGraphCheck, AcceptsInformationOfAnyRankButZero) {
  EXPECT_EQ(complaint([](auto& g) { edge(g).information.bottomRightCorner(5, 5).setZero(); }),
            "accepted");
  EXPECT_THAT(complaint([](auto& g) { edge(g).information.setZero(); }), HasSubstr("all zero"));
}

TEST(PoseGraphCheck, RefusesAKernelWithoutWidth) {
  EXPECT_THAT(complaint([](auto& g) { edge(g).kernel.width = 0; }), HasSubstr("kernel"));
  EXPECT_THAT(complaint([](auto& g) { position(g).kernel.width = NAN; }), HasSubstr("kernel"));
}

TEST(PoseGraph, KindIsThatOfItsNodes) {
  EXPECT_EQ(PoseGraph().kind(), PoseKind::kSE3);
  PoseGraph graph;
  graph.nodes.push_back({NodeId(0), SE2(), false});
  EXPECT_EQ(graph.kind(), PoseKind::kSE2);
  EXPECT_EQ(degrees_of_freedom(PoseKind::kSE2), 3);
  EXPECT_EQ(degrees_of_freedom(PoseKind::kSE3), 6);
  EXPECT_EQ(degrees_of_freedom(PoseKind::kSim3), 7);
}

TEST(PoseGraph, IndexFindsPositionsOfAnyIds) {
  const auto index = make_graph({-5, 1'000'000'000'000, 3}, {}).index_by_id();
  EXPECT_EQ(index.at(NodeId(-5)), 0);
  EXPECT_EQ(index.at(NodeId(1'000'000'000'000)), 1);
  EXPECT_EQ(index.at(NodeId(3)), 2);
}

TEST(PoseGraph, ComponentsCountFromTheFirstNode) {
  EXPECT_THAT(make_graph({1, 2, 3, 4, 5}, {relative(5, 1), relative(2, 4)}).components(),
              ElementsAre(0, 1, 2, 1, 0));
  EXPECT_THAT(make_graph({}, {}).components(), ElementsAre());
}

TEST(PoseGraph, PositionsJoinNothing) {
  PoseGraph graph = make_graph({1, 2}, {});
  for (const NodeId node : {NodeId(1), NodeId(2)}) {
    PositionConstraint gps;
    gps.node = node;
    graph.constraints.push_back(gps);
  }
  EXPECT_THAT(graph.components(), ElementsAre(0, 1));
}

TEST(PoseGraph, SpanningTreePrefersOdometry) {
  // A chain with a loop from end to end, listed first.
  const PoseGraph graph = make_graph(
      {0, 1, 2, 3},
      {relative(0, 3, ConstraintSource::kLoop), relative(0, 1), relative(1, 2), relative(3, 2)});
  EXPECT_THAT(graph.spanning_tree(), ElementsAre(-1, 1, 2, 3));
}

TEST(PoseGraph, SpanningTreeTakesALoopWhereNothingElseLeadsAndGoesOnByOdometry) {
  const PoseGraph graph = make_graph(
      {0, 1, 10, 11}, {relative(0, 1), relative(10, 11), relative(0, 11, ConstraintSource::kLoop),
                       relative(1, 10, ConstraintSource::kLoop)});
  EXPECT_THAT(graph.spanning_tree(), ElementsAre(-1, 0, 1, 2));
  EXPECT_THAT(graph.components(), ElementsAre(0, 0, 0, 0));
}

TEST(PoseGraph, SpanningTreeHasOneRootForEachComponent) {
  EXPECT_THAT(make_graph({1, 2, 3}, {relative(3, 2)}).spanning_tree(), ElementsAre(-1, -1, 0));
}

TEST(PoseGraph, SpanningTreeIsBreadthFirst) {
  // A ring of six: three steps either way from the root.
  const PoseGraph graph =
      make_graph({0, 1, 2, 3, 4, 5}, {relative(0, 1), relative(1, 2), relative(2, 3),
                                      relative(3, 4), relative(4, 5), relative(5, 0)});
  EXPECT_THAT(graph.spanning_tree(), ElementsAre(-1, 0, 1, 2, 4, 5));
}

TEST(PoseGraph, RefusesToWalkAlongAConstraintOnAnUnknownNode) {
  EXPECT_THROW(make_graph({1}, {relative(1, 2)}).components(), ArgumentError);
}

Eigen::Vector3d position_of(const PoseGraph& graph, std::size_t node) {
  return std::get<SE3>(graph.nodes[node].T_world_node).translation();
}

TEST(PoseGraph, OdometryIsIntegratedFromTheRootAlongTheTreeBothWays) {
  // 1 <- 0 -> 2 -> 3, and a loop that contradicts; every edge leads a metre ahead.
  PoseGraph graph = make_graph({1, 0, 2, 3}, {relative(0, 1), relative(0, 2), relative(2, 3),
                                              relative(1, 3, ConstraintSource::kLoop)});
  for (Constraint& constraint : graph.constraints)
    std::get<RelativePoseConstraint>(constraint).T_from_to = SE3(SO3(), {1, 0, 0});
  graph.nodes[0].T_world_node = SE3(SO3(), {10, 0, 0});
  integrate_odometry(graph);
  EXPECT_EQ(position_of(graph, 0), Eigen::Vector3d(10, 0, 0));
  EXPECT_EQ(position_of(graph, 1), Eigen::Vector3d(9, 0, 0));
  EXPECT_EQ(position_of(graph, 2), Eigen::Vector3d(10, 0, 0));
  EXPECT_EQ(position_of(graph, 3), Eigen::Vector3d(11, 0, 0));
}

TEST(PoseGraph, OdometryIsIntegratedOnFromAFixedPoseWhichStays) {
  PoseGraph graph = make_graph({0, 1, 2}, {relative(0, 1), relative(1, 2)});
  for (Constraint& constraint : graph.constraints)
    std::get<RelativePoseConstraint>(constraint).T_from_to = SE3(SO3(), {1, 0, 0});
  graph.nodes[1] = {NodeId(1), SE3(SO3(), {5, 0, 0}), true};
  integrate_odometry(graph);
  EXPECT_EQ(position_of(graph, 1), Eigen::Vector3d(5, 0, 0));
  EXPECT_EQ(position_of(graph, 2), Eigen::Vector3d(6, 0, 0));
}

}  // namespace pose_graph_test
}  // namespace placegraph
