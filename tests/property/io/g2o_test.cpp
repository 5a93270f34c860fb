#include <placegraph/graph/core/random.h>
#include <placegraph/io/graphs/g2o.h>

#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace g2o_test {

using test::TemporaryFolder;

Information random_information(Random& random, int n) {
  Information root(n, n);
  for (int i = 0; i < n * n; ++i) root(i / n, i % n) = random.normal();
  Information information = root * root.transpose();
  return 0.5 * (information + information.transpose().eval());
}

Pose random_pose(Random& random, PoseKind kind) {
  if (kind == PoseKind::kSE2) {
    return SE2(random.normal(0, 100), random.normal(0, 100), random.uniform(-3, 3));
  }
  Vector6d xi;
  for (double& v : xi) v = random.uniform(-1.5, 1.5);
  if (kind == PoseKind::kSim3) return Sim3(SE3::exp(xi).rotation(), xi.head<3>(), std::exp(xi[4]));
  return SE3::exp(xi);
}

PoseGraph random_graph(std::uint64_t seed, PoseKind kind) {
  Random random(seed);
  PoseGraph graph;
  const int n = 30, dof = degrees_of_freedom(kind);
  for (int i = 0; i < n; ++i)
    graph.nodes.push_back({NodeId(3 * i - 10), random_pose(random, kind), i == 4});
  for (int i = 0; i < 3 * n; ++i) {
    RelativePoseConstraint edge;
    edge.from = graph.nodes[static_cast<std::size_t>(random.index(n))].id;
    do {
      edge.to = graph.nodes[static_cast<std::size_t>(random.index(n))].id;
    } while (edge.to == edge.from);
    edge.T_from_to = random_pose(random, kind);
    edge.information = random_information(random, dof);
    edge.source = ConstraintSource::kLoop;  // no two ids are consecutive
    graph.constraints.emplace_back(edge);
  }
  return graph;
}

/// The largest difference of the entries of two poses.
double difference(const Pose& a, const Pose& b) {
  if (const SE2* planar = std::get_if<SE2>(&a)) {
    return (planar->matrix() - std::get<SE2>(b).matrix()).cwiseAbs().maxCoeff();
  }
  if (const Sim3* similar = std::get_if<Sim3>(&a)) {
    return (similar->matrix() - std::get<Sim3>(b).matrix()).cwiseAbs().maxCoeff();
  }
  return (std::get<SE3>(a).matrix() - std::get<SE3>(b).matrix()).cwiseAbs().maxCoeff();
}

/// A landmark graph with fixed vertices among its nodes and points.
LandmarkGraph random_landmark_graph(std::uint64_t seed, PoseKind kind) {
  Random random(seed, 1);
  LandmarkGraph graph;
  graph.poses = random_graph(seed, kind);
  for (PoseNode& node : graph.poses.nodes) node.fixed = random.uniform() < 0.2;
  if (kind == PoseKind::kSim3) return graph;
  const auto node = [&] { return graph.poses.nodes[random.index(30)].id; };
  for (int i = 0; i < 10; ++i) {
    graph.points.push_back({NodeId(1000 + i), Eigen::Vector3d::Zero(), random.uniform() < 0.2});
    graph.observations.push_back({node(), NodeId(1000 + i), Eigen::Vector3d::Zero()});
  }
  graph.priors.push_back(
      {node(), random_pose(random, kind), random_information(random, degrees_of_freedom(kind))});
  return graph;
}

TEST(G2o, FixedVerticesComeBehindAllElse) {
  // The planar reader of gtsam 4.3 ends at the first line of fewer than two numbers.
  for (const PoseKind kind : {PoseKind::kSE2, PoseKind::kSE3, PoseKind::kSim3})
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      const TemporaryFolder folder;
      const LandmarkGraph graph = random_landmark_graph(seed, kind);
      write_g2o(folder / "poses", graph.poses);
      write_g2o(folder / "all", graph);
      for (const char* name : {"poses", "all"}) {
        std::ifstream file(folder / name);
        int fixed = 0;
        for (std::string line; std::getline(file, line);) {
          const bool fixes = line.starts_with("FIX ");
          EXPECT_TRUE(fixes || fixed == 0) << line;
          fixed += fixes;
        }
        EXPECT_GT(fixed, 0);
      }
    }
}

TEST(G2o, IsTheSameAfterWritingAndReading) {
  for (const PoseKind kind : {PoseKind::kSE2, PoseKind::kSE3, PoseKind::kSim3}) {
    // A similarity is written as its logarithm, whose own rounding comes on top.
    const double tolerance = kind == PoseKind::kSim3 ? 1e-12 : 2e-15;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      const TemporaryFolder folder;
      const PoseGraph written = random_graph(seed, kind);
      write_g2o(folder / "a", written);
      const PoseGraph read = read_g2o(folder / "a");
      ASSERT_EQ(read.nodes.size(), written.nodes.size());
      ASSERT_EQ(read.constraints.size(), written.constraints.size());
      // 17 digits give back every double; only the renormalized rotation may move by a few ulp.
      for (std::size_t i = 0; i < read.nodes.size(); ++i) {
        EXPECT_EQ(read.nodes[i].id, written.nodes[i].id);
        EXPECT_EQ(read.nodes[i].fixed, written.nodes[i].fixed);
        EXPECT_LT(difference(read.nodes[i].T_world_node, written.nodes[i].T_world_node), tolerance);
      }
      for (std::size_t i = 0; i < read.constraints.size(); ++i) {
        const auto& a = std::get<RelativePoseConstraint>(read.constraints[i]);
        const auto& b = std::get<RelativePoseConstraint>(written.constraints[i]);
        EXPECT_EQ(a.from, b.from);
        EXPECT_EQ(a.to, b.to);
        EXPECT_EQ(a.source, b.source);
        EXPECT_EQ(Eigen::MatrixXd(a.information), Eigen::MatrixXd(b.information));
        EXPECT_LT(difference(a.T_from_to, b.T_from_to), tolerance);
      }
    }
  }
}

}  // namespace g2o_test
}  // namespace placegraph
