#include "apps/graph_solution.h"

#include <placegraph/graph/graph_parts.h>

#include "apps/output.h"
#include "apps/usage.h"

namespace placegraph::apps {
namespace {

void add_component(PoseGraph component, const GraphPart* part, const PoseGraphOptions& options,
                   const LogSink& log, GraphSolution& solution) {
  const std::int64_t first = component.nodes.front().id;
  PoseGraphReport report = optimize_pose_graph(std::move(component), options, log);
  if (!report.outcome)
    throw NoAnswer((part ? "component of vertex " + std::to_string(first) + ": " : std::string()) +
                   report.outcome.reason);
  solution.iterations += report.iterations;
  if (!part) {
    solution.graph = std::move(report.graph);
    return;
  }
  for (std::size_t i = 0; i < part->nodes.size(); ++i)
    solution.graph.nodes[part->nodes[i]].T_world_node = report.graph.nodes[i].T_world_node;
}

}  // namespace

GraphSolution solve(PoseGraph graph, bool split, const PoseGraphOptions& options,
                    const LogSink& log) {
  const Stopwatch stopwatch;
  GraphSolution solution;
  if (split) {
    std::vector<GraphPart> parts = split_components(graph);
    solution.components = static_cast<int>(parts.size());
    solution.graph = std::move(graph);
    for (GraphPart& part : parts)
      add_component(std::move(part.graph), &part, options, log, solution);
  } else {
    add_component(std::move(graph), nullptr, options, log, solution);
  }
  solution.cpu_ms = stopwatch.cpu_ms();
  solution.wall_ms = stopwatch.wall_ms();
  solution.peak_mb = peak_mb();
  return solution;
}

}  // namespace placegraph::apps
