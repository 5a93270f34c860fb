#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/synthetic/graphs/graph_world.h>

namespace placegraph::synthetic {
namespace graph_world_test {

std::size_t loops(const PoseGraph& graph) {
  std::size_t count = 0;
  for (const Constraint& constraint : graph.constraints)
    count += std::get<RelativePoseConstraint>(constraint).source == ConstraintSource::kLoop;
  return count;
}

template <class Group>
const Group& pose(const PoseGraph& graph, std::size_t i) {
  return std::get<Group>(graph.nodes[i].T_world_node);
}
template <class Group>
const Group& pose(const PoseGraph& graph, NodeId id) {
  return pose<Group>(graph, static_cast<std::size_t>(id.value()));
}

/// The odometry agrees with the start: that is how it was made.
template <class Group>
void expect_integrated(const PoseGraph& graph) {
  for (const Constraint& constraint : graph.constraints) {
    const auto& edge = std::get<RelativePoseConstraint>(constraint);
    if (edge.source != ConstraintSource::kOdometry) continue;
    const Group T_from_to = pose<Group>(graph, edge.from).inverse() * pose<Group>(graph, edge.to);
    EXPECT_LT((std::get<Group>(edge.T_from_to).inverse() * T_from_to).log().norm(), 1e-9);
  }
}

TEST(GraphWorld, AManhattanWalkIsAConnectedGraphWithLoopsAndAnOdometryStart) {
  ManhattanWalkOptions options;
  options.poses = 400;
  const PoseGraph graph = make_manhattan_walk(options);
  graph.check();
  EXPECT_EQ(graph.nodes.size(), 400u);
  EXPECT_EQ(graph.kind(), PoseKind::kSE2);
  EXPECT_GT(loops(graph), 50u);
  expect_integrated<SE2>(graph);
  options.seed = 2;
  EXPECT_NE(pose<SE2>(make_manhattan_walk(options), 399).translation(),
            pose<SE2>(graph, 399).translation());
}

TEST(GraphWorld, AGridWorldJoinsEveryCellToItsNeighbours) {
  GridWorldOptions options;
  options.poses = 125;
  options.loop_share = 1;
  const PoseGraph graph = make_grid_world(options);
  graph.check();
  EXPECT_EQ(graph.nodes.size(), 125u);
  // Of a lattice of 5^3 the 2 * 4 * 25 edges across rows and layers, less those that are the way.
  EXPECT_EQ(loops(graph), 2u * 4 * 25 - (4 * 5 + 4));
  expect_integrated<SE3>(graph);
}

TEST(GraphWorld, ALongLoopHasItsClosuresWhereItIsDrivenAgain) {
  LongLoopOptions options;
  options.poses = 220;
  options.closures = 7;
  for (const PoseKind kind : {PoseKind::kSE2, PoseKind::kSE3}) {
    options.kind = kind;
    const PoseGraph graph = make_long_loop(options);
    graph.check();
    EXPECT_EQ(graph.kind(), kind);
    EXPECT_EQ(loops(graph), 7u);
    for (const Constraint& constraint : graph.constraints) {
      const auto& edge = std::get<RelativePoseConstraint>(constraint);
      if (edge.source == ConstraintSource::kLoop) {
        EXPECT_EQ(edge.to.value() - edge.from.value(), 200);
      }
    }
  }
}

TEST(GraphWorld, RotationNoiseRotatesOdometryAloneAndMovesTheStart) {
  LongLoopOptions options;
  options.poses = 50;
  options.closures = 2;
  const PoseGraph before = make_long_loop(options);
  PoseGraph after = before;
  add_rotation_noise(after, 0.2, 5);
  double squares = 0;
  for (std::size_t i = 0; i < before.constraints.size(); ++i) {
    const auto& a = std::get<RelativePoseConstraint>(before.constraints[i]);
    const auto& b = std::get<RelativePoseConstraint>(after.constraints[i]);
    const SE2 edge_difference = std::get<SE2>(a.T_from_to).inverse() * std::get<SE2>(b.T_from_to);
    EXPECT_EQ(a.information, b.information);
    EXPECT_LT(edge_difference.translation().norm(), 1e-12);
    if (a.source == ConstraintSource::kLoop)
      EXPECT_LT(std::abs(edge_difference.rotation().angle()), 1e-12);
    else
      squares += std::pow(edge_difference.rotation().angle(), 2);
  }
  EXPECT_NEAR(std::sqrt(squares / 49), 0.2, 0.08);  // four standard deviations of 49 draws
  expect_integrated<SE2>(after);
}

TEST(GraphWorld, TheSameSeedGivesTheSameGraph) {
  const PoseGraph a = make_grid_world({}), b = make_grid_world({});
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    EXPECT_EQ(pose<SE3>(a, i).matrix(), pose<SE3>(b, i).matrix());
}

TEST(GraphWorld, FixedPosesAreNeitherIntegratedNorScattered) {
  LongLoopOptions options;
  options.poses = 30;
  options.closures = 1;
  PoseGraph graph = make_long_loop(options);
  graph.nodes[7].fixed = true;
  graph.nodes[7].T_world_node = SE2(100, 0, 0);
  disturb_poses(graph, 10, 3);
  EXPECT_EQ(pose<SE2>(graph, 7).translation()[0], 100);
  EXPECT_LE(pose<SE2>(graph, 8).translation().cwiseAbs().maxCoeff(), 5);
  integrate_odometry(graph);
  EXPECT_EQ(pose<SE2>(graph, 7).translation()[0], 100);
  EXPECT_NEAR(pose<SE2>(graph, 8).translation()[0], 101, 0.5);
}

TEST(GraphWorld, OptionsOutOfRangeAreRefusedByName) {
  EXPECT_THROW((void)make_manhattan_walk({.poses = 1}), ArgumentError);
  EXPECT_THROW((void)make_manhattan_walk({.poses = 2000000000}), ArgumentError);
  EXPECT_THROW((void)make_grid_world({.loop_share = 1.5}), ArgumentError);
  EXPECT_THROW((void)make_long_loop({.laps = 1}), ArgumentError);
  EXPECT_THROW((void)make_long_loop({.kind = PoseKind::kSim3}), ArgumentError);
  EXPECT_THROW((void)make_long_loop({.noise = {.rotation_rad = 0}}), ArgumentError);
}

}  // namespace graph_world_test
}  // namespace placegraph::synthetic
