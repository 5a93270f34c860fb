#include <gtest/gtest.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/io/graphs/g2o.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "tests/support/data.h"

namespace placegraph {
namespace false_loops_test {

Eigen::Matrix3Xd positions(const PoseGraph& graph) {
  Eigen::Matrix3Xd result =
      Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(graph.nodes.size()));
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
    std::visit(
        [&](const auto& pose) {
          const auto& t = pose.translation();
          result.col(static_cast<Eigen::Index>(i)).head(t.size()) = t;
        },
        graph.nodes[i].T_world_node);
  return result;
}

/// Root mean square of the distances after the best rigid motion [m].
double aligned_rms(const PoseGraph& a, const PoseGraph& b) {
  const Eigen::Matrix3Xd from = positions(a), to = positions(b);
  const Eigen::Matrix4d T = Eigen::umeyama(from, to, false);
  const Eigen::Matrix3Xd left =
      ((T.topLeftCorner<3, 3>() * from).colwise() + T.topRightCorner<3, 1>()) - to;
  return std::sqrt(left.squaredNorm() / static_cast<double>(from.cols()));
}

PoseGraphReport optimize(const PoseGraph& graph, RobustMethod method) {
  PoseGraphOptions options;
  options.robust.method = method;
  return optimize_pose_graph(graph, options);
}

class FalseLoops : public testing::TestWithParam<const char*> {};

TEST_P(FalseLoops, TenToAThousandOfThemChangeNothing) {
  const std::string name = GetParam();
  PLACEGRAPH_DATA_OR_SKIP(clean_path, "posegraphs/" + name + ".g2o");
  const PoseGraphReport clean = optimize(read_g2o(clean_path), RobustMethod::kNone);
  for (const int n : {10, 100, 1000}) {
    PLACEGRAPH_DATA_OR_SKIP(path,
                            "posegraphs/outliers/" + name + "_out" + std::to_string(n) + ".g2o");
    const PoseGraphReport report = optimize(read_g2o(path), RobustMethod::kAuto);
    EXPECT_TRUE(report.outcome) << report.outcome.reason;
    EXPECT_LT(aligned_rms(report.graph, clean.graph), 0.01) << n;
    EXPECT_EQ(report.rejected.size(), static_cast<std::size_t>(n));
    for (const RejectedEdge& edge : report.rejected)  // the false ones stand last
      EXPECT_GE(edge.constraint, static_cast<int>(clean.graph.constraints.size()));
  }
}

INSTANTIATE_TEST_SUITE_P(Published, FalseLoops, testing::Values("intel", "kitti_00", "sphere2500"),
                         [](const auto& name) { return std::string(name.param); });

class NoFalseLoops : public testing::TestWithParam<const char*> {};

TEST_P(NoFalseLoops, AutoRejectsNothingAndGivesThePlainOptimum) {
  PLACEGRAPH_DATA_OR_SKIP(path, std::string("posegraphs/") + GetParam() + ".g2o");
  const PoseGraph graph = read_g2o(path);
  const PoseGraphReport plain = optimize(graph, RobustMethod::kNone);
  const PoseGraphReport report = optimize(graph, RobustMethod::kAuto);
  EXPECT_TRUE(report.rejected.empty()) << report.rejected.size();
  EXPECT_LE(report.chi2_final, plain.chi2_final * (1 + 1e-9));
}

INSTANTIATE_TEST_SUITE_P(Published, NoFalseLoops,
                         testing::Values("intel", "M3500", "kitti_00", "kitti_05", "smallGrid3D",
                                         "tinyGrid3D", "sphere2500", "parking-garage"),
                         [](const auto& graph) {
                           std::string name = graph.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace false_loops_test
}  // namespace placegraph
