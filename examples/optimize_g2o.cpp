// Optimizes a pose graph whose loops may be false: optimize_g2o IN.g2o OUT.g2o
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/graphs/g2o.h>

#include <cstdio>

using namespace placegraph;

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s IN.g2o OUT.g2o\n", argv[0]);
    return 2;
  }
  const PoseGraph graph = read_g2o(argv[1]);
  PoseGraphOptions options;
  options.rotation_error = RotationError::kQuaternion;  // as in g2o
  options.robust.method = RobustMethod::kAuto;          // detects false loops
  const PoseGraphReport report = optimize_pose_graph(graph, options);
  if (!report.outcome) {
    std::fprintf(stderr, "no optimum: %s\n", report.outcome.reason.c_str());
    return 1;
  }
  std::printf("%zu nodes, %zu edges: chi2 %g -> %g in %d iterations\n", graph.nodes.size(),
              graph.constraints.size(), report.chi2_initial, report.chi2_final, report.iterations);
  for (const RejectedEdge& edge : report.rejected) {
    const auto& loop = std::get<RelativePoseConstraint>(
        graph.constraints[static_cast<std::size_t>(edge.constraint)]);
    std::printf("false loop from %lld to %lld: %s\n", static_cast<long long>(loop.from.value()),
                static_cast<long long>(loop.to.value()), edge.reason.c_str());
  }
  write_g2o(argv[2], report.graph);
  return 0;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
