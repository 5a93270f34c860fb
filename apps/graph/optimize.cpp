#include "apps/graph/optimize.h"

#include <fmt/format.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/pose_graph_file.h>
#include <placegraph/pipeline/report/graph_page.h>
#include <placegraph/pipeline/report/run_page.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>
#include <vector>

#include "apps/graph/covariance_table.h"
#include "apps/support/choice.h"
#include "apps/support/output.h"
#include "apps/support/plot_file.h"

namespace placegraph::apps {
namespace {

/// e^T Omega e of every constraint in both conventions.
struct ConstraintCosts {
  std::vector<double> g2o, log;

  explicit ConstraintCosts(const PoseGraph& graph)
      : g2o(chi2_by_constraint(graph, RotationError::kQuaternion)),
        log(chi2_by_constraint(graph, RotationError::kLog)) {}

  /// The sums over the constraints that were not rejected.
  GraphCosts without(const std::vector<RejectedEdge>& rejected) const {
    std::vector<char> left_out(g2o.size());
    for (const RejectedEdge& edge : rejected) left_out.at(edge.constraint) = true;
    GraphCosts sums;
    for (std::size_t i = 0; i < g2o.size(); ++i)
      if (!left_out[i]) sums.g2o += g2o[i], sums.log += log[i];
    return sums;
  }
};

using Json = nlohmann::ordered_json;

Json rejected_edges(const GraphSolution& solution) {
  Json list = Json::array();
  for (const RejectedEdge& rejected : solution.rejected) {
    const auto& edge =
        std::get<RelativePoseConstraint>(solution.graph.constraints[rejected.constraint]);
    list.push_back({{"from", edge.from},
                    {"to", edge.to},
                    {"chi2", rejected.chi2},
                    {"reason", rejected.reason}});
  }
  return list;
}

/// Edges that were kept although their chi2 at the solution exceeds the 99.9 % bound.
int doubtful_edges(const GraphSolution& solution) {
  if (solution.chi2_by_constraint.empty()) return 0;
  const double bound = chi_squared_quantile(0.999, degrees_of_freedom(solution.graph.kind()));
  const auto beyond =
      std::count_if(solution.chi2_by_constraint.begin(), solution.chi2_by_constraint.end(),
                    [&](double chi2) { return chi2 > bound; });
  const auto rejected = std::count_if(
      solution.rejected.begin(), solution.rejected.end(),
      [&](const auto& edge) { return solution.chi2_by_constraint[edge.constraint] > bound; });
  return static_cast<int>(beyond - rejected);
}

void tell(const std::vector<Doubt>& doubts, const std::string& in, const LogSink& sink) {
  if (!sink) return;
  for (const Doubt& doubt : doubts)
    sink(LogLevel::kWarning, fmt::format("warning: {}: {}", in, doubt.text));
}

std::vector<NodeId> free_vertices(const GraphSolution& solution) {
  std::vector<NodeId> ids;
  for (const int node : solution.free.nodes) ids.push_back(solution.graph.nodes[node].id);
  return ids;
}

/// Statistics of the times of incremental steps.
struct StepTimes {
  double mean_ms = 0, p95_ms = 0, max_ms = 0;
};

/// Precondition: there is at least one step.
StepTimes times_of(std::vector<double> cpu_ms) {
  std::sort(cpu_ms.begin(), cpu_ms.end());
  const std::size_t count = cpu_ms.size();
  const double sum = std::accumulate(cpu_ms.begin(), cpu_ms.end(), 0.0);
  return {sum / static_cast<double>(count), cpu_ms[(count * 95 + 99) / 100 - 1], cpu_ms.back()};
}

void describe_steps(const std::vector<double>& cpu_ms, Json& report) {
  if (cpu_ms.empty()) return;
  const StepTimes times = times_of(cpu_ms);
  report["steps"] = cpu_ms.size();
  report["step_cpu_ms_mean"] = times.mean_ms;
  report["step_cpu_ms_p95"] = times.p95_ms;
  report["step_cpu_ms_max"] = times.max_ms;
}

void describe_certificate(const GraphSolution& solution, Json& report) {
  report["refined_from_certified"] = solution.refined_from_certified;
  report["certified"] = solution.certificate && solution.certificate->certified;
  report["certified_problem"] = nullptr;
  if (!solution.certificate) return;
  const ChordalIsotropicCertificate& certificate = *solution.certificate;
  report["certified_problem"] = ChordalIsotropicCertificate::kProblem;
  report["certificate_gap"] = certificate.relative_gap;
  report["certificate_cost"] = certificate.cost;
  report["certificate_cost_of_estimate"] = certificate.cost_of_estimate;
  report["certificate_lower_bound"] = certificate.lower_bound;
  report["smallest_eigenvalue"] = certificate.smallest_eigenvalue;
  report["eigenvalue_scale"] = certificate.eigenvalue_scale;
  report["certificate_cpu_ms"] = solution.certificate_cpu_ms;
}

void draw(const std::string& path, const PoseGraph& before, const GraphSolution& solution,
          const GraphCosts& costs) {
  std::vector<int> rejected;
  for (const RejectedEdge& edge : solution.rejected) rejected.push_back(edge.constraint);
  write_plot(path,
             graph_picture(before, solution.graph, rejected,
                           fmt::format("{} poses, {} constraints", solution.graph.nodes.size(),
                                       solution.graph.constraints.size()),
                           {fmt::format("chi2 {:.5g} (log), {:.5g} (g2o); not aligned", costs.log,
                                        costs.g2o)}));
}

/// Checks all arguments and returns the options that their names stand for.
PoseGraphOptions checked_options(const OptimizeArguments& arguments) {
  PoseGraphOptions options = arguments.task.options;
  options.rotation_error = choice<RotationError>("--cost", optimize_costs(), arguments.cost);
  options.engine =
      choice<PoseGraphEngine>("--engine", pose_graph_option("engine").choices, arguments.engine);
  options.initialization = choice<PoseGraphInitialization>(
      "--initialization", pose_graph_option("initialization").choices, arguments.initialization);
  options.robust.method = choice<RobustMethod>(
      "--robust", pose_graph_option("robust.method").choices, arguments.robust);
  options.check();
  require(
      !arguments.task.incremental || (arguments.robust == "none" && arguments.engine == "native" &&
                                      arguments.initialization == "auto"),
      "--incremental goes with --engine native, --robust none and --initialization auto");
  require(!arguments.drop_rejected || arguments.robust != "none",
          "--drop-rejected goes with --robust, which rejects");
  require_plot_name(arguments.plot);
  if (!arguments.report.empty()) require_page_name(arguments.report);
  require_free(arguments.out, arguments.force);
  for (const std::string& path : {arguments.covariances, arguments.plot, arguments.report})
    if (!path.empty()) require_free(path, arguments.force);
  return options;
}

/// Rejects options that do not apply to a graph with priors and point landmarks, by name.
void require_for_landmarks(const OptimizeArguments& arguments, const GraphTask& task,
                           const LandmarkGraph& graph) {
  const PoseGraphOptions& options = task.options;
  const bool other_start = options.initialization != PoseGraphInitialization::kAuto &&
                           options.initialization != PoseGraphInitialization::kFile;
  const std::vector<std::pair<bool, std::string>> refused = {
      {options.robust.method != RobustMethod::kNone, "--robust " + arguments.robust},
      {task.incremental, "--incremental"},
      {task.certify, "--certify"},
      {other_start, "--initialization " + arguments.initialization},
      {!arguments.plot.empty(), "--plot"},
      {!arguments.report.empty(), "--report"}};
  for (const auto& [given, option] : refused)
    require(!given, fmt::format("{}: has priors or point landmarks, which {} does not take",
                                arguments.in, option));
  require(
      options.rotation_error == RotationError::kLog ||
          std::ranges::none_of(graph.priors, &PosePriorConstraint::beside_node),
      arguments.in +
          ": has priors of a sensor that stands beside its vertex (PARAMS_SE3OFFSET), which are "
          "exact for --cost log alone");
}

void optimize_landmarks(const OptimizeArguments& arguments, const GraphTask& task,
                        LandmarkGraph graph, const LogSink& sink, OptimizeResult& result) {
  require_for_landmarks(arguments, task, graph);
  try {
    result.landmarks = solve_landmarks(std::move(graph), task.options);
  } catch (const NoResult& reason) {
    throw NoResult(arguments.in + ": " + reason.what());
  }
  const LandmarkSolution& solution = *result.landmarks;
  if (!std::isfinite(solution.chi2_log))
    throw NoResult(arguments.in + ": the cost of the solution is not finite");
  if (!arguments.covariances.empty())
    write_covariances(arguments.covariances, arguments.in, solution.graph,
                      task.options.rotation_error);
  tell(solution.doubts, arguments.in, sink);
  write_g2o(arguments.out, solution.graph);
}

void optimize_poses(const OptimizeArguments& arguments, const GraphTask& task, PoseGraph start,
                    const LogSink& sink, OptimizeResult& result) {
  const ConstraintCosts before(start);
  const GraphCosts given = before.without({});
  if (!std::isfinite(given.g2o + given.log))
    throw FileError(arguments.in, "the cost at the given poses is not finite: numbers too large");
  const PoseGraph drawn = arguments.plot.empty() ? PoseGraph() : start;
  if (!arguments.report.empty()) result.start = start;
  GraphSolution& solution = result.solution;
  try {
    solution = solve(std::move(start), task, sink);
  } catch (const NoResult& reason) {
    throw NoResult(arguments.in + ": " + reason.what());
  }
  const PoseGraph kept = without_rejected(solution.graph, solution.rejected);
  result.before = before.without(solution.rejected);
  result.after = ConstraintCosts(kept).without({});
  if (!std::isfinite(result.after.g2o + result.after.log))
    throw NoResult(arguments.in + ": the cost of the solution is not finite");
  if (!arguments.covariances.empty())
    write_covariances(arguments.covariances, arguments.in, kept, task.options.rotation_error);
  if (!arguments.plot.empty()) draw(arguments.plot, drawn, solution, result.after);
  tell(solution.doubts, arguments.in, sink);
  write_g2o(arguments.out, arguments.drop_rejected ? kept : solution.graph);
}

Json describe(const OptimizeResult& result) {
  const char* const kinds[] = {"SE2", "SE3", "Sim3"};
  const GraphSolution& solution = result.solution;
  Json report;
  report["in"] = result.in;
  report["out"] = result.out;
  report["cost"] = result.cost;
  report["engine"] = result.engine;
  report["initialization"] = solution.initialization;
  report["robust"] = result.robust;
  report["kind"] = kinds[static_cast<int>(solution.graph.kind())];
  report["nodes"] = solution.graph.nodes.size();
  report["constraints"] = solution.graph.constraints.size();
  report["components"] = solution.components;
  report["degrees_of_freedom"] = solution.degrees_of_freedom;
  report["chi2_g2o_initial"] = result.before.g2o;
  report["chi2_log_initial"] = result.before.log;
  report["chi2_g2o"] = result.after.g2o;
  report["chi2_log"] = result.after.log;
  report["iterations"] = solution.iterations;
  report["cpu_ms"] = solution.cpu_ms;
  report["wall_ms"] = solution.wall_ms;
  report["peak_mb"] = solution.peak_mb;
  report["free_directions"] = solution.free.count;
  report["free_vertices"] = free_vertices(solution);
  describe_certificate(solution, report);
  describe_steps(solution.step_cpu_ms, report);
  report["loops_judged"] = result.robust != "none" && solution.loops_judged;
  report["rejected"] = solution.rejected.size();
  report["rejected_edges"] = rejected_edges(solution);
  report["doubtful"] = doubtful_edges(solution);
  return report;
}

/// A line on the edges that were kept although they are far off; empty without any.
std::string doubtful_text(const OptimizeResult& result) {
  const int doubtful = doubtful_edges(result.solution);
  if (doubtful == 0 || result.robust == "none") return {};
  const bool weighs = result.robust == "huber" || result.robust == "dcs";
  return fmt::format(
      "  {} constraints kept that lie beyond the 99.9 % bound of their chi2{}\n", doubtful,
      weighs ? "; the method gives them less weight, chi2 above counts them in full" : "");
}

/// Lines on the certificate and on the incremental steps; empty without them.
std::string details_text(const GraphSolution& solution) {
  std::string text;
  if (const auto& certificate = solution.certificate)
    text += fmt::format(
        "  {}: the isotropic chordal problem's minimum here lies at most {:.2g} above its "
        "global one (smallest eigenvalue {:.3g})\n",
        certificate->certified ? "certified" : "not certified", certificate->relative_gap,
        certificate->smallest_eigenvalue);
  if (solution.step_cpu_ms.empty()) return text;
  const StepTimes times = times_of(solution.step_cpu_ms);
  return text +
         fmt::format("  {} steps of {:.2f} ms CPU on average, 95 % below {:.2f}, at most {:.2f}\n",
                     solution.step_cpu_ms.size(), times.mean_ms, times.p95_ms, times.max_ms);
}

}  // namespace

OptionEntry pose_graph_option(const std::string& path) {
  for (OptionEntry& entry : list_options(PoseGraphOptions()))
    if (entry.path == path) return entry;
  throw ArgumentError("no option of the backend: " + path);
}

const std::vector<std::string>& optimize_costs() {
  static const std::vector<std::string> names = {"log", "g2o"};
  return names;
}

OptimizeResult optimize(const OptimizeArguments& arguments, const LogSink& sink) {
  GraphTask task = arguments.task;
  task.options = checked_options(arguments);
  std::vector<std::string> remarks;
  OptimizeResult result;
  LandmarkGraph read = read_landmark_graph(
      arguments.in, {.connected = !task.split,
                     .remarks = &remarks,
                     .indefinite = choice<IndefiniteInformation>(
                         "--indefinite", indefinite_information_names(), arguments.indefinite),
                     .replaced = &result.replaced});
  for (const std::string& remark : remarks) warn(arguments.in + ": " + remark);
  result.in = arguments.in;
  result.out = arguments.out;
  result.cost = arguments.cost;
  result.engine = arguments.engine;
  result.robust = arguments.robust;
  if (read.has_poses_alone())
    optimize_poses(arguments, task, std::move(read.poses), sink, result);
  else
    optimize_landmarks(arguments, task, std::move(read), sink, result);
  return result;
}

std::string to_json(const OptimizeResult& result) {
  Json report;
  if (result.landmarks) {
    report = {{"in", result.in}, {"out", result.out}, {"cost", result.cost}};
    report.update(describe(*result.landmarks));
  } else {
    report = describe(result);
  }
  report["doubts"] = Json::array();
  for (const Doubt& doubt : result.landmarks ? result.landmarks->doubts : result.solution.doubts)
    report["doubts"].push_back(doubt.text);
  report["replaced_information"] = result.replaced;
  return json_text(report, 2);
}

std::string to_text(const OptimizeResult& result) {
  const std::string replaced =
      result.replaced == 0
          ? ""
          : fmt::format("  {} edges of indefinite information, which was replaced\n",
                        result.replaced);
  if (result.landmarks)
    return to_text(*result.landmarks, result.in, result.cost, result.out) + replaced;
  const GraphSolution& solution = result.solution;
  const char* const kinds[] = {"SE2", "SE3", "Sim3"};
  std::string text =
      fmt::format("{}: {}, {} nodes, {} constraints, minimized in the {} convention\n", result.in,
                  kinds[static_cast<int>(solution.graph.kind())], solution.graph.nodes.size(),
                  solution.graph.constraints.size(), result.cost);
  if (solution.components > 1)
    text += fmt::format("  {} components, each for itself\n", solution.components);
  text += fmt::format("  chi2 (g2o: half-angle quaternion) {:.6f} -> {:.6f}\n", result.before.g2o,
                      result.after.g2o);
  text += fmt::format("  chi2 (logarithm)                  {:.6f} -> {:.6f}\n", result.before.log,
                      result.after.log);
  if (!solution.rejected.empty())
    text += fmt::format("  {} constraints rejected\n", solution.rejected.size());
  text += replaced + doubtful_text(result) + details_text(solution);
  return text +
         fmt::format(
             "  {} iterations, {:.1f} ms CPU, {:.1f} ms wall, {:.0f} MB at most; written to {}\n",
             solution.iterations, solution.cpu_ms, solution.wall_ms, solution.peak_mb, result.out);
}

}  // namespace placegraph::apps
