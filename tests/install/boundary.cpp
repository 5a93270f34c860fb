// Hands every type that Eigen would align by the instruction set into the installed library and out
// of it, in containers and by value, and prints what comes back: the same numbers from every
// compilation.
#include <placegraph/backend/factors/pose_prior.h>
#include <placegraph/backend/factor_graph/factor_graph.h>
#include <placegraph/placegraph.h>

#include <cstdio>

using namespace placegraph;

int main() {
  // Rotations are quaternions, poses hold them beside vectors of three.
  Trajectory trajectory;
  std::vector<SE3> poses;
  for (int i = 0; i < 50; ++i) {
    poses.push_back(SE3(SO3::exp({0.01 * i, 0.02 * i, 0}), {0.1 * i, 0, 0.5 * i}));
    trajectory.poses.push_back({i * 100'000'000ll, poses.back().isometry()});
  }
  const EvaluationResult same = evaluate(trajectory, trajectory);

  // Information matrices of six rows in a list of variants.
  PoseGraph graph;
  for (int i = 0; i < 50; ++i) {
    graph.nodes.push_back({NodeId(i), poses[static_cast<std::size_t>(i)], i == 0});
    if (i == 0) continue;
    RelativePoseConstraint edge;
    edge.from = NodeId(i - 1), edge.to = NodeId(i);
    edge.T_from_to = poses[static_cast<std::size_t>(i - 1)].inverse() *
                     poses[static_cast<std::size_t>(i)] * SE3(SO3(), {0.01, 0, 0});
    edge.information = Matrix6d::Identity();
    graph.constraints.push_back(edge);
  }
  const PoseGraphReport report = optimize_pose_graph(graph, {});
  const Eigen::Vector3d end = std::get<SE3>(report.graph.nodes.back().T_world_node).translation();

  // Variables of a factor graph by value, and its covariance.
  FactorGraph factors;
  const int pose = factors.add_variable(poses[7]);
  factors.add(PosePriorFactor<SE3>(poses[8], Matrix6d::Identity()), {pose});
  const FactorGraphReport solved = optimize_factor_graph(factors, {});
  const MarginalCovariance marginal = marginal_covariance(solved.graph, {pose});
  const Eigen::Vector3d t = solved.graph.value<SE3>(pose).translation();

  if (!same.outcome || !report.outcome || !solved.outcome || !marginal.outcome) return 1;
  std::printf("%d frames, %.9f m\n%.6f %.6f %.6f\n%.6f %.6f %.6f, %.6f\n", same.frames, same.path_m,
              end.x(), end.y(), end.z(), t.x(), t.y(), t.z(), marginal.covariance.trace());
  return 0;
}
