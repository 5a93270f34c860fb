#include <gtest/gtest.h>
#include <placegraph/backend/georeference/variance_components.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/graph/core/random.h>

#include "tests/support/seed.h"

namespace placegraph {
namespace variance_components_test {

constexpr double kSigma = 0.1;  ///< of the odometry and of the positions, metres and radians

/// Two hundred steps whose noise is kSigma, each claimed to be `claimed_t`, `claimed_r`, and a
/// position at every node.
PoseGraph walk(double claimed_t, double claimed_r, Random random) {
  PoseGraph graph;
  SE2 T_world_node;
  const SE2 step(1, 0, 0.1);
  for (std::int64_t id = 0; id < 200; ++id) {
    if (id > 0) {
      RelativePoseConstraint edge;
      edge.from = NodeId(id - 1);
      edge.to = NodeId(id);
      const Eigen::Vector3d noise(random.normal(0, kSigma), random.normal(0, kSigma),
                                  random.normal(0, kSigma));
      edge.T_from_to = step.plus(noise);
      edge.information = Eigen::Vector3d(1 / (claimed_t * claimed_t), 1 / (claimed_t * claimed_t),
                                         1 / (claimed_r * claimed_r))
                             .asDiagonal();
      graph.constraints.emplace_back(edge);
      T_world_node = T_world_node * step;
    }
    graph.nodes.push_back({NodeId(id), T_world_node});
    PositionConstraint position;
    position.node = NodeId(id);
    position.position_world << T_world_node.translation().x() + random.normal(0, kSigma),
        T_world_node.translation().y() + random.normal(0, kSigma), 0;
    position.information = Eigen::Matrix3d::Identity() / (kSigma * kSigma);
    graph.constraints.emplace_back(position);
  }
  PoseGraphOptions options;
  options.initialization = PoseGraphInitialization::kFile;
  return optimize_pose_graph(graph, options).graph;
}

TEST(VarianceComponents, FindsNothingWrongWithTrueClaims) {
  const Random random = test::seeded_random(3);
  const VarianceComponents found = odometry_variance_components(walk(kSigma, kSigma, random));
  EXPECT_LT(std::abs(found.translation.deviations), 4.5);
  EXPECT_LT(std::abs(found.rotation.deviations), 4.5);
  EXPECT_NEAR(found.translation.factor, 1, 0.3);
  EXPECT_NEAR(found.rotation.factor, 1, 0.4);
  // 200 positions of two components check 199 steps of three.
  EXPECT_LT(found.translation.redundancy + found.rotation.redundancy, 400);
  EXPECT_GT(found.translation.redundancy, 100);
}

TEST(VarianceComponents, ConvergesToTheScatterWhateverWasClaimed) {
  const Random random = test::seeded_random(3);
  for (const double wrong : {0.2, 5.0}) {
    PoseGraph graph = walk(wrong * kSigma, wrong * kSigma, random);
    double translation = 1, rotation = 1;
    const VarianceComponents first = odometry_variance_components(graph);
    EXPECT_EQ(first.translation.deviations > 0, wrong < 1);
    EXPECT_GT(std::abs(first.translation.deviations), 3);
    for (int round = 0; round < 15; ++round) {
      const VarianceComponents found = odometry_variance_components(graph);
      translation *= found.translation.factor;
      rotation *= found.rotation.factor;
      scale_odometry(graph, found.translation.factor, found.rotation.factor);
      PoseGraphOptions options;
      options.initialization = PoseGraphInitialization::kFile;
      graph = optimize_pose_graph(graph, options).graph;
    }
    EXPECT_NEAR(std::log(translation * wrong), 0, 0.35);
    EXPECT_NEAR(std::log(rotation * wrong), 0, 0.35);
  }
}

TEST(VarianceComponents, SaysNothingWhereNothingIsChecked) {
  PoseGraph graph;
  graph.nodes = {{NodeId(0), SE2(0, 0, 0)}, {NodeId(1), SE2(3, 4, 1)}};
  RelativePoseConstraint edge;
  edge.to = NodeId(1);
  edge.T_from_to = SE2(3, 4, 1);
  edge.information = Information::Identity(3, 3);
  graph.constraints.emplace_back(edge);
  const VarianceComponents found = odometry_variance_components(graph);
  EXPECT_EQ(found.translation.factor, 1);
  EXPECT_EQ(found.translation.deviations, 0);
  // Two variances of 1; one of 1 at a radius of half of the distance of 5.
  EXPECT_NEAR(claimed_drift(graph).by_translation, std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(claimed_drift(graph).by_rotation, 2.5, 1e-12);
}

}  // namespace variance_components_test
}  // namespace placegraph
