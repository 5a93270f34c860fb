#include <gtest/gtest.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>

#include <set>

#include "tests/support/scenes/graph_surroundings.h"

/// What stands beside a graph, and how the graph is written, changes nothing of its solution.
namespace placegraph {
namespace graph_components_test {

using test::LoopedWalk;
using test::SurroundedGraph;
using test::Surroundings;

constexpr std::uint64_t kSeeds = 6;
/// Descents end where the cost falls by less than 1e-9 of itself: about as far from the minimum.
constexpr double kDescentEnds_m = 1e-4;

PoseGraphReport optimize(const PoseGraph& graph, RobustMethod method) {
  PoseGraphOptions options;
  options.robust.method = method;
  options.max_iterations = 1000;
  PoseGraphReport report = optimize_pose_graph(graph, options);
  EXPECT_TRUE(report.outcome) << report.outcome.reason;
  return report;
}

std::set<int> rejected_of(const PoseGraphReport& report) {
  std::set<int> rejected;
  for (const RejectedEdge& edge : report.rejected) rejected.insert(edge.constraint);
  return rejected;
}

template <class Group>
PoseGraph walk_with_false_loops(std::uint64_t seed, int false_loops) {
  PoseGraph graph =
      LoopedWalk<Group>({.nodes = 200, .lap = 40, .loop_every = 4, .claimed = 0.02,
                         .false_loops = false_loops, .seed = seed})
          .graph;
  graph.nodes.front().fixed = true;
  return graph;
}

/// Expects the solution `found` of a surrounded graph to be that of the graph alone.
template <class Group>
void expect_the_same(const PoseGraphReport& alone, const PoseGraphReport& found,
                     const SurroundedGraph<Group>& surrounded, double tolerance) {
  const std::set<int> rejected_alone = rejected_of(alone), rejected = rejected_of(found);
  for (std::size_t i = 0; i < surrounded.constraint.size(); ++i)
    EXPECT_EQ(rejected.contains(surrounded.constraint[i]),
              rejected_alone.contains(static_cast<int>(i)))
        << "constraint " << i;
  double worst = 0;
  for (std::size_t i = 0; i < surrounded.node.size(); ++i) {
    const auto& a = std::get<Group>(alone.graph.nodes[i].T_world_node);
    const auto& b = std::get<Group>(found.graph.nodes[surrounded.node[i]].T_world_node);
    worst = std::max(worst, (a.translation() - b.translation()).norm());
  }
  EXPECT_LE(worst, tolerance);
}

template <class Group>
class GraphComponentsOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3>;
TYPED_TEST_SUITE(GraphComponentsOf, Groups);

TYPED_TEST(GraphComponentsOf, WhatIsConnectedWithNothingElseChangesNoBit) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
    for (const RobustMethod method : {RobustMethod::kNone, RobustMethod::kAuto}) {
      Random random(seed);
      Surroundings surroundings;
      surroundings.lone_vertices = seed % 2 == 1;
      surroundings.second_component = seed % 3 != 1;
      surroundings.surveyed_chain = seed % 3 == 1;
      SCOPED_TRACE(testing::Message() << "seed " << seed << ":" << surroundings.text());
      const PoseGraph graph = walk_with_false_loops<TypeParam>(seed, static_cast<int>(seed % 3));
      const SurroundedGraph<TypeParam> surrounded(graph, surroundings, random);
      expect_the_same<TypeParam>(optimize(graph, method), optimize(surrounded.graph, method),
                                 surrounded, 0);
    }
}

TYPED_TEST(GraphComponentsOf, NoSurroundingsChangeTheLoopsThatAreLeftOut) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
    for (const RobustMethod method :
         {RobustMethod::kNone, RobustMethod::kAuto, RobustMethod::kGnc, RobustMethod::kPcm}) {
      Random random(seed, 1);
      const Surroundings surroundings = Surroundings::draw(random);
      SCOPED_TRACE(testing::Message() << "seed " << seed << ":" << surroundings.text() << " method "
                                      << static_cast<int>(method));
      const PoseGraph graph = walk_with_false_loops<TypeParam>(seed, 1 + static_cast<int>(seed % 3));
      const SurroundedGraph<TypeParam> surrounded(graph, surroundings, random);
      expect_the_same<TypeParam>(optimize(graph, method), optimize(surrounded.graph, method),
                                 surrounded, kDescentEnds_m);
    }
}

}  // namespace graph_components_test
}  // namespace placegraph
