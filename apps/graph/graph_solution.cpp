#include "apps/graph/graph_solution.h"

#include <fmt/format.h>
#include <placegraph/backend/internal/incremental/incremental_replay.h>
#include <placegraph/backend/internal/pose_graph/initialization_selection.h>
#include <placegraph/backend/internal/solver/free_directions.h>
#include <placegraph/graph/internal/core/id_format.h>
#include <placegraph/graph/internal/core/log_message.h>
#include <placegraph/graph/pose_graph/graph_parts.h>

#include <algorithm>

#include "apps/support/output.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

constexpr int kStepsPerLine = 500;  ///< steps between two lines of progress

PoseGraphReport solve_incrementally(const PoseGraph& graph, const GraphTask& task,
                                    const LogSink& log, std::vector<double>& step_cpu_ms) {
  IncrementalOptions options;
  options.rotation_error = task.options.rotation_error;
  const auto watch = [&](int steps, const IncrementalOptimizer& optimizer) {
    if (steps % kStepsPerLine == 0)
      placegraph::log(log, LogLevel::kDebug, "{} of {} poses, cost {:.9g}", steps,
                      graph.nodes.size(), optimizer.cost());
  };
  IncrementalReplay replay = optimize_incrementally(graph, options, watch);
  step_cpu_ms.insert(step_cpu_ms.end(), replay.step_cpu_ms.begin(), replay.step_cpu_ms.end());
  PoseGraphReport report;
  report.outcome = replay.outcome;
  report.iterations = replay.iterations;
  report.graph = std::move(replay.graph);
  if (report.outcome) report.free = find_free_directions(report.graph, options.rotation_error);
  report.initialization_used = PoseGraphInitialization::kOdometry;
  return report;
}

PoseGraphReport optimize(PoseGraph graph, const GraphTask& task, const LogSink& log,
                         GraphSolution& solution) {
  PoseGraphReport report = task.incremental
                               ? solve_incrementally(graph, task, log, solution.step_cpu_ms)
                               : optimize_pose_graph(std::move(graph), task.options, log);
  if (!report.outcome) throw NoResult(report.outcome.reason);
  solution.iterations += report.iterations;
  solution.initialization = to_string(report.initialization_used);
  solution.loops_judged = solution.loops_judged && report.loops_judged;
  solution.refined_from_certified = report.refined_from_certified;
  return report;
}

void solve_whole(PoseGraph graph, const GraphTask& task, const LogSink& log,
                 GraphSolution& solution) {
  PoseGraphReport report = optimize(std::move(graph), task, log, solution);
  solution.graph = std::move(report.graph);
  solution.free = std::move(report.free);
  solution.rejected = std::move(report.rejected);
  solution.chi2_by_constraint = std::move(report.chi2_by_constraint);
}

void solve_parts(PoseGraph graph, const GraphTask& task, const LogSink& log,
                 GraphSolution& solution) {
  std::vector<GraphPart> parts = split_components(graph);
  solution.components = static_cast<int>(parts.size());
  solution.graph = std::move(graph);
  if (!task.incremental) solution.chi2_by_constraint.resize(solution.graph.constraints.size());
  for (GraphPart& part : parts) {
    const NodeId first = part.graph.nodes.front().id;
    PoseGraphReport report;
    try {
      report = optimize(std::move(part.graph), task, log, solution);
    } catch (const NoResult& reason) {
      throw NoResult(fmt::format("component of vertex {}: {}", first, reason.what()));
    }
    for (std::size_t i = 0; i < part.nodes.size(); ++i)
      solution.graph.nodes[part.nodes[i]].T_world_node = report.graph.nodes[i].T_world_node;
    solution.free.count += report.free.count;
    for (const int node : report.free.nodes) solution.free.nodes.push_back(part.nodes[node]);
    for (std::size_t i = 0; i < report.chi2_by_constraint.size(); ++i)
      solution.chi2_by_constraint[part.constraints[i]] = report.chi2_by_constraint[i];
    for (RejectedEdge& edge : report.rejected) {
      edge.constraint = part.constraints[edge.constraint];
      solution.rejected.push_back(std::move(edge));
    }
  }
  std::sort(solution.free.nodes.begin(), solution.free.nodes.end());
  std::sort(solution.rejected.begin(), solution.rejected.end(),
            [](const auto& a, const auto& b) { return a.constraint < b.constraint; });
}

template <class Group>
ChordalIsotropicCertificate certify(const GraphSolution& solution, RotationError rotation_error) {
  PackedGraph<Group> packed = pack<Group>(solution.graph);
  std::vector<char> rejected(solution.graph.constraints.size());
  for (const RejectedEdge& edge : solution.rejected) rejected[edge.constraint] = true;
  for (auto& edge : packed.edges)
    if (rejected[edge.constraint]) edge.weight = 0;
  return certify_chordal_isotropic(packed, rotation_error);
}

ChordalIsotropicCertificate certify(const GraphSolution& solution, RotationError rotation_error) {
  switch (solution.graph.kind()) {
    case PoseKind::kSE2:
      return certify<SE2>(solution, rotation_error);
    case PoseKind::kSE3:
      return certify<SE3>(solution, rotation_error);
    case PoseKind::kSim3:
      break;
  }
  return certify<Sim3>(solution, rotation_error);
}

}  // namespace

GraphSolution solve(PoseGraph graph, const GraphTask& task, const LogSink& log) {
  const Stopwatch stopwatch;
  GraphSolution solution;
  (task.split ? solve_parts : solve_whole)(std::move(graph), task, log, solution);
  solution.cpu_ms = stopwatch.cpu_ms();
  solution.wall_ms = stopwatch.wall_ms();
  solution.peak_mb = peak_mb();
  if (task.certify) {
    const Stopwatch certifying;
    solution.certificate = certify(solution, task.options.rotation_error);
    solution.certificate_cpu_ms = certifying.cpu_ms();
  }
  return solution;
}

}  // namespace placegraph::apps
