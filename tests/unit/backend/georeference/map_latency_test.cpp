#include <gtest/gtest.h>
#include <placegraph/backend/georeference/map_latency.h>

namespace placegraph {
namespace map_latency_test {

constexpr std::int64_t kStep_ns = 100'000'000;

/// A curve of poses a tenth of a second and a metre apart.
Trajectory curve(int count) {
  Trajectory motion;
  SE3 T_map_body;
  for (int i = 0; i < count; ++i) {
    motion.poses.push_back({i * kStep_ns, T_map_body.isometry()});
    Vector6d step;
    step << 1, 0, 0, 0, 0, 0.1;
    T_map_body = T_map_body.plus(step);
  }
  return motion;
}

PoseGraph graph_of(const Trajectory& motion) {
  PoseGraph map;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const auto id = static_cast<std::int64_t>(i);
    map.nodes.push_back({NodeId(id), SE3(*motion.poses[i].T_world_body)});
    if (i == 0) continue;
    RelativePoseConstraint edge;
    edge.from = NodeId(id - 1);
    edge.to = NodeId(id);
    edge.T_from_to = std::get<SE3>(map.nodes[i - 1].T_world_node).inverse() *
                     std::get<SE3>(map.nodes[i].T_world_node);
    edge.information = Information::Identity(6, 6);
    map.constraints.emplace_back(edge);
  }
  return map;
}

std::vector<NodeVisit> visits_of(const PoseGraph& map) {
  std::vector<NodeVisit> visits;
  for (const PoseNode& node : map.nodes) visits.push_back({node.id.value() * kStep_ns, node.id});
  return visits;
}

TEST(MapDelay, TakesEveryNodeAndEdgeToWhereTheMotionIsLater) {
  const Trajectory motion = curve(10);
  PoseGraph map = graph_of(motion);
  const auto steps = steps_of_delay(map, visits_of(map), motion, 0.2, 1.0);
  move_nodes(map, steps);
  for (std::size_t i = 0; i + 2 < motion.size(); ++i) {
    const SE3 T_map_later(*motion.poses[i + 2].T_world_body);
    EXPECT_LT((std::get<SE3>(map.nodes[i].T_world_node).inverse() * T_map_later).log().norm(),
              1e-9);
  }
  for (const Constraint& constraint : map.constraints) {
    const auto& edge = std::get<RelativePoseConstraint>(constraint);
    const SE3 T_from_to =
        std::get<SE3>(map.nodes[static_cast<std::size_t>(edge.from.value())].T_world_node)
            .inverse() *
        std::get<SE3>(map.nodes[static_cast<std::size_t>(edge.to.value())].T_world_node);
    EXPECT_LT((std::get<SE3>(edge.T_from_to).inverse() * T_from_to).log().norm(), 1e-9);
  }
}

TEST(MapDelay, RepeatsTheLastStepBeyondTheEndAndGoesBackAsWell) {
  const Trajectory motion = curve(10);
  const Trajectory later = without_delay(motion, 0.1, 1.0);
  // A curve of constant turn goes on as it went.
  const Trajectory longer = curve(11);
  EXPECT_TRUE(later.poses[9].T_world_body->isApprox(*longer.poses[10].T_world_body, 1e-9));
  const Trajectory back = without_delay(later, -0.1, 1.0);
  for (std::size_t i = 0; i < motion.size(); ++i)
    EXPECT_TRUE(back.poses[i].T_world_body->isApprox(*motion.poses[i].T_world_body, 1e-9));
}

TEST(MapDelay, LeavesNodesWithoutAVisitAndMotionWithoutNeighboursWhereTheyAre) {
  const Trajectory motion = curve(2);
  PoseGraph map = graph_of(motion);
  const auto steps = steps_of_delay(map, {{0, NodeId(0)}}, motion, 0.05, 1.0);
  EXPECT_NEAR(steps[0].translation().x(), 0.5, 0.01);
  EXPECT_EQ(steps[1].log().norm(), 0);
  const Trajectory still = without_delay(curve(1), 0.05, 1.0);
  EXPECT_TRUE(still.poses[0].T_world_body->isApprox(Eigen::Isometry3d::Identity()));
}

TEST(MapDelay, MovesPlanarNodesInThePlane) {
  PoseGraph map;
  map.nodes = {{NodeId(0), SE2(0, 0, 0)}, {NodeId(1), SE2(1, 0, 0.2)}};
  RelativePoseConstraint edge;
  edge.to = NodeId(1);
  edge.T_from_to = SE2(1, 0, 0.2);
  edge.information = Information::Identity(3, 3);
  map.constraints.emplace_back(edge);
  move_nodes(map, {SE3(SO3::exp({0, 0, 0.1}), {0.5, 0, 0}), SE3()});
  const SE2 moved = std::get<SE2>(map.nodes[0].T_world_node);
  EXPECT_NEAR(moved.translation().x(), 0.5, 1e-12);
  EXPECT_NEAR(moved.rotation().angle(), 0.1, 1e-12);
  const SE2 between = std::get<SE2>(std::get<RelativePoseConstraint>(map.constraints[0]).T_from_to);
  EXPECT_NEAR(between.rotation().angle(), 0.1, 1e-12);
  EXPECT_NEAR(between.translation().norm(), 0.5, 1e-12);
}

}  // namespace map_latency_test
}  // namespace placegraph
