// Optimizes a pose graph: optimize_g2o IN.g2o OUT.g2o
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/graphs/g2o.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: optimize_g2o IN.g2o OUT.g2o\n");
    return 2;
  }
  try {
    placegraph::PoseGraph graph = placegraph::read_g2o(argv[1]);
    for (placegraph::Constraint& constraint : graph.constraints) {
      // A false loop must not bend the map: let the far ones go.
      auto* relative = std::get_if<placegraph::RelativePoseConstraint>(&constraint);
      if (relative && relative->source == placegraph::ConstraintSource::kLoop)
        relative->kernel = {placegraph::RobustKernel::Kind::kDcs, 3.0};
    }
    placegraph::PoseGraphOptions options;
    options.rotation_error = placegraph::RotationError::kQuaternion;  // as g2o counts
    const placegraph::PoseGraphReport report = placegraph::optimize_pose_graph(graph, options);
    std::printf("%zu nodes, %zu constraints: chi2 %g -> %g in %d iterations\n", graph.nodes.size(),
                graph.constraints.size(), report.chi2_initial, report.chi2_final,
                report.iterations);
    if (!report.outcome) {
      std::fprintf(stderr, "no optimum: %s\n", report.outcome.reason.c_str());
      return 1;
    }
    placegraph::write_g2o(argv[2], report.graph);
  } catch (const placegraph::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
