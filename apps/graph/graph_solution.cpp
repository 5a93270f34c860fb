#include "apps/graph/graph_solution.h"

#include <fmt/format.h>
#include <placegraph/backend/incremental/incremental_replay.h>
#include <placegraph/backend/solver/free_directions.h>
#include <placegraph/backend/solver/graph_components.h>

#include <numeric>

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
    if (log && steps % kStepsPerLine == 0)
      log(LogLevel::kDebug,
          fmt::format("{} of {} poses, cost {:.9g}", steps, graph.nodes.size(), optimizer.cost()));
  };
  IncrementalReplay replay = optimize_incrementally(graph, options, watch);
  step_cpu_ms.insert(step_cpu_ms.end(), replay.step_cpu_ms.begin(), replay.step_cpu_ms.end());
  PoseGraphReport report;
  report.outcome = replay.outcome;
  report.iterations = replay.iterations;
  report.graph = std::move(replay.graph);
  report.chi2_by_constraint = chi2_by_constraint(report.graph, options.rotation_error);
  report.chi2_final =
      std::accumulate(report.chi2_by_constraint.begin(), report.chi2_by_constraint.end(), 0.0);
  report.degrees_of_freedom = find_components(report.graph).degrees_of_freedom;
  if (report.outcome) {
    report.free = find_free_directions(report.graph, options.rotation_error);
    report.doubts = doubts_of(report, RobustMethod::kNone);
  }
  report.initialization_used = PoseGraphInitialization::kOdometry;
  return report;
}

}  // namespace

GraphSolution solve(PoseGraph graph, const GraphTask& task, const LogSink& log) {
  const Stopwatch stopwatch;
  GraphSolution solution;
  PoseGraphReport report = task.incremental
                               ? solve_incrementally(graph, task, log, solution.step_cpu_ms)
                               : optimize_pose_graph(std::move(graph), task.options, log);
  if (!report.outcome) throw NoResult(report.outcome.reason);
  solution.graph = std::move(report.graph);
  solution.iterations = report.iterations;
  solution.initialization = to_string(report.initialization_used);
  solution.refined_from_certified = report.refined_from_certified;
  solution.rejected = std::move(report.rejected);
  solution.chi2_by_constraint = std::move(report.chi2_by_constraint);
  solution.loops_judged = report.loops_judged;
  solution.free = std::move(report.free);
  solution.doubts = std::move(report.doubts);
  solution.degrees_of_freedom = report.degrees_of_freedom;
  solution.cpu_ms = stopwatch.cpu_ms();
  solution.wall_ms = stopwatch.wall_ms();
  solution.peak_mb = peak_mb();
  const PoseGraph kept = without_rejected(solution.graph, solution.rejected);
  solution.components = find_components(kept).count();
  if (task.certify) {
    const Stopwatch certifying;
    solution.certificate = certify_chordal_isotropic(kept, task.options.rotation_error);
    solution.certificate_cpu_ms = certifying.cpu_ms();
  }
  return solution;
}

}  // namespace placegraph::apps
