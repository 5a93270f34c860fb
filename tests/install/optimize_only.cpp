// Optimizes a square of four poses whose odometry drifts and whose loop closes it: graph and
// backend of the installed library.
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>

#include <cstdio>
#include <numbers>

int main() {
  using namespace placegraph;
  const auto edge = [](NodeId from, NodeId to, const SE2& T_from_to) {
    RelativePoseConstraint constraint;
    constraint.from = from;
    constraint.to = to;
    constraint.T_from_to = T_from_to;
    constraint.information = Eigen::Matrix3d::Identity();
    return constraint;
  };
  const double quarter = std::numbers::pi / 2;
  PoseGraph graph;
  SE2 T_world_node;
  for (int i = 0; i < 4; ++i) {
    graph.nodes.push_back({NodeId(i), T_world_node, i == 0});
    T_world_node = T_world_node * SE2(1.1, 0.05, quarter + 0.05);
    graph.constraints.push_back(edge(NodeId(i), NodeId((i + 1) % 4), SE2(1, 0, quarter)));
  }
  const PoseGraphReport report = optimize_pose_graph(graph, {});
  std::printf("chi2 %g -> %g\n", report.chi2_initial, report.chi2_final);
  // The measurements agree with one another: the square is exact.
  const SE2& corner = std::get<SE2>(report.graph.nodes[2].T_world_node);
  const bool exact = (corner.translation() - Eigen::Vector2d(1, 1)).norm() < 1e-6;
  return report.outcome && report.chi2_initial > 1e-2 && report.chi2_final < 1e-10 && exact ? 0 : 1;
}
